// Sparsity pattern of a matrix and of its triangular factors, computed once and shared by all
// matrices with that pattern. A gearbox couples its planets only through the carrier, the ring and
// the sun, so a good elimination order causes almost no fill-in.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace gearpod::lockstep {

// Positions of nonzero entries: entry e is in row `to[e]` and column `from[e]`. A product with a
// vector adds value e times element `from[e]` to element `to[e]`. Entries are sorted by column, so
// that few consecutive additions depend on each other.
struct SparseEntries {
    std::vector<int> to, from;
    int size() const { return static_cast<int>(to.size()); }
};

// Entries of `matrix` that differ from zero.
SparseEntries nonzero_entries(const Eigen::MatrixXd& matrix);

// Pattern of the factors A = L D U (unit diagonals of L and U) of matrices with the nonzeros of
// `pattern` (square; its transpose counts too). Elimination follows `order` without row exchanges.
// The entries are sorted so that L y = g and then U x = y can be solved in place.
struct SparseLu {
    std::vector<int> order;
    SparseEntries lower, upper;
};
SparseLu eliminate(const Eigen::MatrixXd& pattern);

// Factors with L below, D on and U above the diagonal, in the row and column order of A. The matrix
// must not need row exchanges; symmetric positive definite matrices do not.
Eigen::MatrixXd factors(const SparseLu& lu, const Eigen::MatrixXd& matrix);

}  // namespace gearpod::lockstep
