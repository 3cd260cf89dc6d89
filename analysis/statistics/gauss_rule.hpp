// Gauss quadrature from the three-term recurrence of orthogonal polynomials: the nodes are the
// eigenvalues of the symmetric tridiagonal matrix of the recurrence, the weights the squares of its
// eigenvectors' first entries (G. H. Golub, J. H. Welsch, Math. Comput. 23 (1969), 221-230).
#pragma once

#include <Eigen/Core>

namespace gearpod::analysis {

struct GaussRule {
    Eigen::VectorXd nodes;    // ascending
    Eigen::VectorXd weights;  // sum to the measure's total
};

// `diagonal` has an entry a node, `beside` one less: polynomials p_k of unit norm with
// x p_k = beside[k - 1] p_(k-1) + diagonal[k] p_k + beside[k] p_(k+1).
GaussRule gauss_rule(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside, double total);

// Expectations over the standard normal law.
GaussRule normal_gauss_rule(int nodes);

}  // namespace gearpod::analysis
