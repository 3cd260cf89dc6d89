// Symmetric Toeplitz equations of the autocorrelation of a periodic signal, for linear prediction
// and deconvolution.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Circular autocorrelation r_k = (1/n) sum over i of x_i x_((i+k) mod n) for k = 0 to `lags` - 1,
// with 1e-9 of r_0 added to r_0. This white-noise correction (-90 dB) bounds the condition number
// of the Toeplitz matrix by about 1e9 times its size, so that tones without noise have a solution,
// too.
std::vector<double> corrected_autocorrelation(std::span<const double> signal, std::size_t lags);

// Solution x of sum over j of r_|i-j| x_j = b_i by Levinson's recursion; N. Levinson, J. Math.
// Phys. 25 (1947) 261-278. `r` and `b` have equal sizes, at least one; the matrix must be positive
// definite.
std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b);

// y_i = sum over l of f_l x_((i-l) mod n).
std::vector<double> circular_filter(std::span<const double> filter, std::span<const double> signal);

// (1/n) sum over i of y_i x_((i-l) mod n) for l = 0 to `lags` - 1.
std::vector<double> circular_correlation(std::span<const double> x, std::span<const double> y,
                                         std::size_t lags);

}  // namespace gearpod::signals
