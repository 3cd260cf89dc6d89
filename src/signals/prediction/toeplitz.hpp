// Symmetric Toeplitz equations, for linear prediction and deconvolution.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Solution x of sum over j of r_|i-j| x_j = b_i by Levinson's recursion; N. Levinson, J. Math.
// Phys. 25 (1947) 261-278. `r` and `b` have equal sizes, at least one; the matrix must be positive
// definite.
std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b);

}  // namespace gearpod::signals
