// Eight doubles that are added and multiplied at once: the value type with which a generic solver
// marches eight gearboxes abreast.
#pragma once

namespace gearpod::peers {

struct alignas(64) Eight {
    double x[8];

    Eight() = default;
    Eight(double all) {  // NOLINT: a number is eight of them
        for (double& value : x) {
            value = all;
        }
    }
    Eight operator-() const { return Eight(0.0) - *this; }
    Eight& operator+=(const Eight& other) { return *this = *this + other; }
    Eight& operator-=(const Eight& other) { return *this = *this - other; }

#define GEARPOD_EIGHT_OPERATOR(OP)                             \
    friend Eight operator OP(const Eight& a, const Eight& b) { \
        Eight result;                                          \
        for (int l = 0; l < 8; ++l) {                          \
            result.x[l] = a.x[l] OP b.x[l];                    \
        }                                                      \
        return result;                                         \
    }                                                          \
    friend Eight operator OP(double a, const Eight& b) {       \
        Eight result;                                          \
        for (int l = 0; l < 8; ++l) {                          \
            result.x[l] = a OP b.x[l];                         \
        }                                                      \
        return result;                                         \
    }
    GEARPOD_EIGHT_OPERATOR(+)
    GEARPOD_EIGHT_OPERATOR(-)
    GEARPOD_EIGHT_OPERATOR(*)
#undef GEARPOD_EIGHT_OPERATOR
};

}  // namespace gearpod::peers
