#include "dynamics/gearbox_matrices.hpp"

#include <cmath>
#include <numbers>

#include "dynamics/dense_algebra.hpp"

namespace gearpod::dynamics {

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

}  // namespace gearpod::dynamics
