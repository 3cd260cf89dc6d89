// Gauss quadrature from the three-term recurrence of orthogonal polynomials. The nodes are the
// eigenvalues of the recurrence's symmetric tridiagonal matrix (G. H. Golub, J. H. Welsch, Math.
// Comput. 23 (1969), 221-230). The weights are the Christoffel numbers, 1 over the sum of the
// squared orthonormal polynomials at the node.
#pragma once

#include <Eigen/Core>

namespace gearpod::analysis {

struct GaussRule {
    Eigen::VectorXd nodes;    // ascending
    Eigen::VectorXd weights;  // sum to the total of the measure
};

// Rule with one node per entry of `diagonal`; `off_diagonal` is the off-diagonal, one entry
// shorter. For polynomials p_k of unit norm: x p_k = off_diagonal[k - 1] p_(k-1) + diagonal[k]
// p_k + off_diagonal[k] p_(k+1). `total`: total of the measure.
GaussRule gauss_rule(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                     double total);

// Rule for expectations over the standard normal distribution.
GaussRule normal_gauss_rule(int nodes);

}  // namespace gearpod::analysis
