#include "dynamics/gearbox_matrices.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

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
    // The complete orthogonal decomposition gives the least-norm solution, which leaves the rigid
    // rotation, the null vector of a free gearbox, at zero.
    const Eigen::MatrixXd k = matrices.stiffness + matrices.centrifugal;
    return k.completeOrthogonalDecomposition().solve(matrices.force);
}

std::vector<double> natural_frequencies_Hz(const GearboxMatrices& matrices) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        matrices.stiffness, matrices.mass, Eigen::EigenvaluesOnly);
    std::vector<double> frequencies;
    const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();
    for (const double value : solver.eigenvalues()) {
        // A rigid rotation comes out as rounding noise of either sign.
        frequencies.push_back(
            std::abs(value) < 1e-10 * largest ? 0.0 : std::sqrt(value) / (2.0 * std::numbers::pi));
    }
    return frequencies;
}

}  // namespace gearpod::dynamics
