// Eight doubles with elementwise arithmetic: the value type with which a generic solver integrates
// eight realizations in parallel. Uses the compiler's vectors: loops over an array of eight take
// 1.15 times as long.
#pragma once

#include <cstring>

namespace gearpod::peers {

struct Eight {
    typedef double Vector __attribute__((vector_size(64)));
    Vector x;

    Eight() = default;
    Eight(double all) : x(Vector{} + all) {}  // NOLINT: implicit conversion
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
