#include "dynamics/rotating_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

namespace gearpod::dynamics {

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
