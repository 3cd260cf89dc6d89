#include "analysis/statistics/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gearpod::analysis {

GaussRule gauss_rule(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside, double total) {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal, beside);
    return {solver.eigenvalues(), total * solver.eigenvectors().row(0).cwiseAbs2().transpose()};
}

GaussRule normal_gauss_rule(int nodes) {
    Eigen::VectorXd beside(nodes - 1);
    for (Eigen::Index k = 0; k < beside.size(); ++k) {
        beside[k] = std::sqrt(static_cast<double>(k + 1));  // recurrence of the Hermite polynomials
    }
    return gauss_rule(Eigen::VectorXd::Zero(nodes), beside, 1.0);
}

}  // namespace gearpod::analysis
