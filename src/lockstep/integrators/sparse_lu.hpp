// Which entries of a matrix, and of its triangular factors, can differ from zero; found once and
// shared by all matrices of that pattern. A gearbox couples its planets only through the carrier,
// the ring and the sun, so that with a good order of elimination next to no entry fills in.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace gearpod::lockstep {

// Entry e stands in row `to[e]` and column `from[e]`: a product with a vector takes value e times
// element `from[e]` to element `to[e]`. Column by column, so that few entries in a row wait for
// each other.
struct SparseEntries {
    std::vector<int> to, from;
    int size() const { return static_cast<int>(to.size()); }
};

// Entries of `matrix` that differ from zero.
SparseEntries nonzero_entries(const Eigen::MatrixXd& matrix);

// Factors A = L D U (ones on the diagonals of L and U) of matrices with the nonzeros of `pattern`
// (square; its transpose counts too), eliminated in `order` without exchange of rows. The entries
// come in the order in which L y = g and then U x = y can be solved in place.
struct SparseLu {
    std::vector<int> order;
    SparseEntries lower, upper;
};
SparseLu eliminate(const Eigen::MatrixXd& pattern);

// L below, D on and U above the diagonal, for the rows and columns of A in their own order. The
// matrix must have factors without exchange of rows, as a symmetric positive matrix has.
Eigen::MatrixXd factors(const SparseLu& lu, const Eigen::MatrixXd& matrix);

}  // namespace gearpod::lockstep
