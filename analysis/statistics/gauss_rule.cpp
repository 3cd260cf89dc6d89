#include "analysis/statistics/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gearpod::analysis {

GaussRule gauss_rule(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                     double total) {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal, off_diagonal, Eigen::EigenvaluesOnly);
    const Eigen::ArrayXd x = solver.eigenvalues();
    Eigen::ArrayXd before = Eigen::ArrayXd::Zero(x.size()), here = Eigen::ArrayXd::Ones(x.size());
    Eigen::ArrayXd sum = Eigen::ArrayXd::Ones(x.size());
    for (Eigen::Index k = 0; k < off_diagonal.size(); ++k) {
        before = ((x - diagonal[k]) * here - (k > 0 ? off_diagonal[k - 1] : 0.0) * before) /
                 off_diagonal[k];
        before.swap(here);
        sum += here.square();
    }
    return {x, total / sum};
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
