#include "lockstep/integrators/sparse_lu.hpp"

#include <algorithm>

namespace gearpod::lockstep {
namespace {

using Pattern = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Row with the fewest neighbours among the remaining ones; this greedy order (minimum degree)
// causes little fill-in.
int minimum_degree_row(const Pattern& filled, const std::vector<int>& left) {
    const auto neighbours = [&](int row) {
        return std::count_if(left.begin(), left.end(),
                             [&](int other) { return other != row && filled(row, other); });
    };
    return *std::min_element(left.begin(), left.end(),
                             [&](int a, int b) { return neighbours(a) < neighbours(b); });
}

}  // namespace

SparseEntries nonzero_entries(const Eigen::MatrixXd& matrix) {
    SparseEntries entries;
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
            if (matrix(row, column) != 0.0) {
                entries.to.push_back(static_cast<int>(row));
                entries.from.push_back(static_cast<int>(column));
            }
        }
    }
    return entries;
}

SparseLu eliminate(const Eigen::MatrixXd& pattern) {
    Pattern filled = pattern.array() != 0.0 || pattern.transpose().array() != 0.0;
    std::vector<int> left(static_cast<std::size_t>(pattern.rows()));
    for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] = static_cast<int>(i);
    }
    SparseLu lu;
    while (!left.empty()) {
        const int pivot = minimum_degree_row(filled, left);
        lu.order.push_back(pivot);
        left.erase(std::find(left.begin(), left.end(), pivot));
        for (const int row : left) {
            for (const int column : left) {
                filled(row, column) =
                    filled(row, column) || (filled(row, pivot) && filled(pivot, column));
            }
        }
    }
    const auto add = [&](SparseEntries& entries, std::size_t row, std::size_t column) {
        if (filled(lu.order[row], lu.order[column])) {
            entries.to.push_back(lu.order[row]);
            entries.from.push_back(lu.order[column]);
        }
    };
    const std::size_t n = lu.order.size();
    for (std::size_t column = 0; column < n; ++column) {
        for (std::size_t row = column + 1; row < n; ++row) {
            add(lu.lower, row, column);
        }
    }
    for (std::size_t column = n; column-- > 0;) {
        for (std::size_t row = 0; row < column; ++row) {
            add(lu.upper, row, column);
        }
    }
    return lu;
}

Eigen::MatrixXd factors(const SparseLu& lu, const Eigen::MatrixXd& matrix) {
    Eigen::MatrixXd f = matrix(lu.order, lu.order);
    for (Eigen::Index i = 0; i < f.rows(); ++i) {
        const Eigen::Index rest = f.rows() - i - 1;
        f.col(i).tail(rest) /= f(i, i);
        f.bottomRightCorner(rest, rest).noalias() -= f.col(i).tail(rest) * f.row(i).tail(rest);
        f.row(i).tail(rest) /= f(i, i);
    }
    Eigen::MatrixXd result(f.rows(), f.cols());
    result(lu.order, lu.order) = f;
    return result;
}

}  // namespace gearpod::lockstep
