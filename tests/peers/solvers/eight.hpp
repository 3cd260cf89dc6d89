// Eight doubles that are added and multiplied at once: the value type with which a generic solver
// marches eight gearboxes abreast. On the compiler's own vectors: an array of eight, looped over,
// takes 1.15 times as long.
#pragma once

#include <cstring>

namespace gearpod::peers {

struct Eight {
    typedef double Vector __attribute__((vector_size(64)));
    Vector x;

    Eight() = default;
    Eight(double all) : x(Vector{} + all) {}  // NOLINT: a number is eight of them
    Eight(Vector all) : x(all) {}             // NOLINT
    static Eight load(const double* from) {
        Eight all;
        std::memcpy(&all.x, from, sizeof all.x);
        return all;
    }
    Eight operator-() const { return -x; }
    Eight& operator+=(const Eight& other) { return *this = *this + other; }
    Eight& operator-=(const Eight& other) { return *this = *this - other; }

    friend Eight operator+(const Eight& a, const Eight& b) { return a.x + b.x; }
    friend Eight operator-(const Eight& a, const Eight& b) { return a.x - b.x; }
    friend Eight operator*(const Eight& a, const Eight& b) { return a.x * b.x; }
};

}  // namespace gearpod::peers
