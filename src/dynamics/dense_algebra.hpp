// Factorisations of a gearbox's matrices, whose templates are compiled here alone: they take the
// compiler longer than a kernel.
#pragma once

#include <Eigen/Core>

namespace gearpod::dynamics {

struct EigenPairs {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;  // a column each
};

struct Modes {
    Eigen::VectorXd squares;  // (rad/s)^2, the smallest first
    Eigen::MatrixXd shapes;   // a column each
};

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);
EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);
// The solution of least norm.
Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
// Of symmetric matrices.
Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
bool positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace gearpod::dynamics
