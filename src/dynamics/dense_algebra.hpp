// Factorisations of a gearbox's matrices, whose templates are compiled here alone: they take the
// compiler longer than a kernel.
#pragma once

#include <Eigen/Core>

namespace gearpod::dynamics {

struct EigenPairs {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;  // a column each
};

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);
EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);
// Of a symmetric matrix.
bool positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace gearpod::dynamics
