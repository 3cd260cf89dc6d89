// Minimum-entropy deconvolution: R. A. Wiggins, Geoexploration 16 (1978) 21-35; for gear faults: H.
// Endo and R. B. Randall, Mech. Syst. Signal Process. 21 (2007) 906-919.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::signals {

// Periodic signal x filtered by the `length` coefficients f that make the result y as impulsive as
// possible. f starts as an impulse at length / 2. Each of `iterations` solves
//
//     sum over m of r_|l-m| f_m = sum over i of y_i^3 x_(i-l),   l = 0 to length - 1,
//
// with the autocorrelation r of x (periodic_signal.hpp), and scales y to an RMS of 1. These are the
// conditions for a stationary kurtosis of y. Few iterations may stop short of the maximum. x must
// not be zero.
std::vector<double> deconvolve(std::span<const double> x, std::size_t length, int iterations);

}  // namespace gearpod::signals
