// Factorizations of a gearbox's matrices. The Eigen templates are instantiated only in
// dense_algebra.cpp, because they take longer to compile than a kernel.
#pragma once

#include <Eigen/Core>

namespace gearpod::dynamics {

struct EigenPairs {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;  // one per column
};

struct Modes {
    Eigen::VectorXd squares;  // natural angular frequencies squared, (rad/s)^2, ascending
    Eigen::MatrixXd shapes;   // one per column
};

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);
EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);
// Minimum-norm solution.
Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
// Undamped modes; both matrices must be symmetric.
Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
bool positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace gearpod::dynamics
