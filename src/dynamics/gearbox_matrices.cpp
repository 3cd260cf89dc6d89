#include "dynamics/gearbox_matrices.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "machine/contracts.hpp"

namespace gearpod::dynamics {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
    return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) {
    return matrix.inverse();
}

Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
    return matrix.completeOrthogonalDecomposition().solve(right);
}

Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
    EXPECTS(stiffness.isApprox(stiffness.transpose()) && mass.isApprox(mass.transpose()));
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

bool positive_definite(const Eigen::MatrixXd& matrix) {
    return Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
}

GearboxMatrices zero_matrices(int motions) {
    GearboxMatrices m;
    m.mass = Eigen::MatrixXd::Zero(motions, motions);
    m.damping = m.stiffness = m.gyroscopic = m.centrifugal = m.mass;
    m.force = Eigen::VectorXd::Zero(motions);
    return m;
}

void add(GearboxMatrices& matrices, const SpringDamper& spring) {
    matrices.stiffness += spring.stiffness * spring.row * spring.row.transpose();
    matrices.damping += spring.damping * spring.row * spring.row.transpose();
}

Eigen::VectorXd static_equilibrium(const GearboxMatrices& matrices) {
    // The least-norm solution has no component along the rigid rotation, the null vector of a free
    // gearbox.
    return solve(matrices.stiffness + matrices.centrifugal, matrices.force);
}

std::vector<double> natural_frequencies_Hz(const GearboxMatrices& matrices) {
    const Eigen::VectorXd squares = modes(matrices.stiffness, matrices.mass).squares;
    std::vector<double> frequencies;
    const double largest = squares.cwiseAbs().maxCoeff();
    for (const double value : squares) {
        // The eigenvalue of a rigid rotation is rounding error of either sign.
        frequencies.push_back(
            std::abs(value) < 1e-10 * largest ? 0.0 : std::sqrt(value) / (2.0 * std::numbers::pi));
    }
    return frequencies;
}

std::vector<double> rotating_frequencies_Hz(const GearboxMatrices& matrices) {
    const Eigen::Index n = matrices.mass.rows();
    const Eigen::LLT<Eigen::MatrixXd> mass(matrices.mass);
    Eigen::MatrixXd first_order = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    first_order.topRightCorner(n, n).setIdentity();
    first_order.bottomLeftCorner(n, n) = -mass.solve(matrices.stiffness + matrices.centrifugal);
    first_order.bottomRightCorner(n, n) = -mass.solve(matrices.gyroscopic);
    const Eigen::VectorXcd values =
        Eigen::EigenSolver<Eigen::MatrixXd>(first_order, false).eigenvalues();
    // Eigenvalues come in pairs +-i w; those of a rigid rotation are rounding errors.
    constexpr double kRounding = 1e-6;
    const double largest = values.imag().cwiseAbs().maxCoeff();
    std::vector<double> frequencies;
    for (const std::complex<double>& value : values) {
        if (value.imag() > kRounding * largest) {
            frequencies.push_back(value.imag() / (2.0 * std::numbers::pi));
        }
    }
    frequencies.resize(static_cast<std::size_t>(n), 0.0);
    std::ranges::sort(frequencies);
    return frequencies;
}

}  // namespace gearpod::dynamics
