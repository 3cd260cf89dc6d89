#include "lockstep/step_limit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <limits>

namespace gearpod::lockstep {
namespace {

double growth(std::complex<double> z) {
    return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

// The longest h along which |R(h lambda)| stays at most 1.
double longest_step(std::complex<double> lambda) {
    const double unit = 1.0 / std::abs(lambda);
    constexpr double kResolution = 1e-3;  // of h |lambda|; the limit lies near 2.8
    double z = kResolution;
    while (z < 4.0 && growth(z * unit * lambda) <= 1.0 + 1e-12) {
        z += kResolution;
    }
    return (z - kResolution) * unit;
}

}  // namespace

StepLimit runge_kutta_limit(const dynamics::GearboxMatrices& m) {
    const Eigen::Index n = m.mass.rows();
    const Eigen::MatrixXd inverse_mass = m.mass.inverse();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    system.topRightCorner(n, n).setIdentity();
    system.bottomLeftCorner(n, n) = -inverse_mass * (m.stiffness + m.centrifugal);
    system.bottomRightCorner(n, n) = -inverse_mass * (m.damping + m.gyroscopic);
    const Eigen::VectorXcd eigenvalues =
        Eigen::EigenSolver<Eigen::MatrixXd>(system, false).eigenvalues();
    const double largest = eigenvalues.cwiseAbs().maxCoeff();

    StepLimit limit{std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
    for (const std::complex<double> lambda : eigenvalues) {
        const double size = std::abs(lambda);
        if (size < 1e-4 * largest || lambda.real() > 1e-9 * size) {
            continue;
        }
        limit.step_s = std::min(limit.step_s, longest_step(lambda));
        limit.slowest_decay_1_s = std::min(limit.slowest_decay_1_s, std::max(0.0, -lambda.real()));
    }
    return limit;
}

}  // namespace gearpod::lockstep
