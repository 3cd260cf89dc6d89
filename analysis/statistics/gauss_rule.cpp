#include "analysis/statistics/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gearpod::analysis {

GaussRule gauss_rule(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                     double total) {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal, off_diagonal);
    return {solver.eigenvalues(), total * solver.eigenvectors().row(0).cwiseAbs2().transpose()};
}

GaussRule normal_gauss_rule(int nodes) {
    Eigen::VectorXd off_diagonal(nodes - 1);
    for (Eigen::Index k = 0; k < off_diagonal.size(); ++k) {
        off_diagonal[k] =
            std::sqrt(static_cast<double>(k + 1));  // recurrence of the Hermite polynomials
    }
    return gauss_rule(Eigen::VectorXd::Zero(nodes), off_diagonal, 1.0);
}

}  // namespace gearpod::analysis
