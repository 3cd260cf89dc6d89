#include "lockstep/steps/step_limit.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "dynamics/dense_algebra.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"

namespace gearpod::lockstep {
namespace {

// R(z)|^2; avoids the square root, because it is evaluated thousands of times per mode.
double growth_squared(std::complex<double> z, const IntegratorFacts& integrator) {
    const std::complex<double> r = integrator.growth(z);
    return r.real() * r.real() + r.imag() * r.imag();
}

// Largest h for which |R(h lambda)| stays at most 1 from 0 to h, or one of at least `enough`.
double longest_step(std::complex<double> lambda, const IntegratorFacts& integrator, double enough) {
    const double unit = 1.0 / std::abs(lambda);
    constexpr double kResolution = 1e-3;  // of h |lambda|; the limits lie near 2.8 and 1.7 to 2.5
    double z = kResolution;
    while (z < 4.0 && (z - kResolution) * unit < enough &&
           growth_squared(z * unit * lambda, integrator) <= 1.0 + 2e-12) {
        z += kResolution;
    }
    return (z - kResolution) * unit;
}

Eigen::VectorXcd modes(const dynamics::GearboxMatrices& m) {
    return dynamics::eigenvalues(state_matrix(m));
}

// Rate below which a mode counts as the rigid rotation. Its exact rate is 0; rounding and the
// linearized centrifugal term add a small one. Both scale with the stiffest spring, never with the
// dampers.
double rigid_rate(const dynamics::GearboxMatrices& m) {
    const Eigen::VectorXd rates2 =
        (m.stiffness.diagonal().array() / m.mass.diagonal().array()).matrix();
    return 1e-4 * std::sqrt(rates2.maxCoeff());
}

// Eigenvalues of all modes but the rigid rotation and those that grow by themselves.
std::vector<std::complex<double>> decaying_modes(const dynamics::GearboxMatrices& m) {
    std::vector<std::complex<double>> decaying;
    const double rigid = rigid_rate(m);
    for (const std::complex<double> lambda : modes(m)) {
        const double size = std::abs(lambda);
        if (size >= rigid && lambda.real() <= 1e-9 * size) {
            decaying.push_back(lambda);
        }
    }
    return decaying;
}

}  // namespace

Eigen::MatrixXd state_matrix(const dynamics::GearboxMatrices& m) {
    const Eigen::Index n = m.mass.rows();
    const Eigen::MatrixXd inverse_mass = dynamics::inverse(m.mass);
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    system.topRightCorner(n, n).setIdentity();
    system.bottomLeftCorner(n, n) = -inverse_mass * (m.stiffness + m.centrifugal);
    system.bottomRightCorner(n, n) = -inverse_mass * (m.damping + m.gyroscopic);
    return system;
}

double slowest_decay_1_s(const dynamics::GearboxMatrices& m) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const std::complex<double> lambda : decaying_modes(m)) {
        slowest = std::min(slowest, std::max(0.0, -lambda.real()));
    }
    return slowest;
}

double longest_stable_step(const dynamics::GearboxMatrices& m, Integrator integrator) {
    const IntegratorFacts& method = facts(integrator);
    if (method.stable_step != nullptr) {
        return method.stable_step(m);
    }
    // The fastest modes come first: they leave little to examine of the others.
    std::vector<std::complex<double>> modes = decaying_modes(m);
    std::sort(modes.begin(), modes.end(), [](std::complex<double> a, std::complex<double> b) {
        return std::abs(a) > std::abs(b);
    });
    double longest = std::numeric_limits<double>::infinity();
    for (const std::complex<double> lambda : modes) {
        if (lambda.imag() >= 0.0) {  // conjugates grow alike
            longest = std::min(longest, longest_step(lambda, method, longest));
        }
    }
    return longest;
}

StiffPart stiffest_part(const dynamics::GearboxLayout& layout,
                        const dynamics::GearboxInputs& inputs,
                        const std::vector<double>& pair_stiffness_N_m) {
    const dynamics::GearboxMatrices m = dynamics::assemble(layout, inputs, pair_stiffness_N_m);
    const dynamics::EigenPairs modes = dynamics::eigen_pairs(state_matrix(m));
    Eigen::Index fastest = 0;
    modes.values.cwiseAbs().maxCoeff(&fastest);
    const double rate = std::abs(modes.values(fastest));
    // Velocity half of the eigenvector; the displacements are far smaller.
    const Eigen::Index n = m.mass.rows();
    const Eigen::VectorXcd mode = modes.vectors.col(fastest).tail(n);

    StiffPart result;
    result.rate_1_s = rate;
    double most = 0.0;
    for (const auto& spring : dynamics::spring_dampers(layout, inputs, pair_stiffness_N_m)) {
        // Terms lambda c and k of the mode's equation lambda^2 m + lambda c + k = 0.
        const double deflection = std::norm(spring.row.cast<std::complex<double>>().dot(mode));
        const double by_damper = rate * spring.damping * deflection;
        const double by_spring = spring.stiffness * deflection;
        if (std::max(by_damper, by_spring) > most) {
            most = std::max(by_damper, by_spring);
            result.part =
                (by_damper > by_spring ? "the damper of " : "the spring of ") + spring.name;
        }
    }
    Eigen::Index heaviest = 0;
    (m.mass.diagonal().array() * mode.cwiseAbs2().array()).maxCoeff(&heaviest);
    result.motion = dynamics::motion_names(layout)[static_cast<std::size_t>(heaviest)];
    return result;
}

Integrator choose_integrator(double stable_steps_per_mesh) {
    return stable_steps_per_mesh <= kMostExplicitSteps ? kUsualExplicit : kUsualImplicit;
}

double implicit_steps(Integrator integrator, const dynamics::GearboxMatrices& m,
                      double mesh_period_s, double low_pass_rad_s) {
    double fastest = low_pass_rad_s;
    for (const std::complex<double> lambda : modes(m)) {
        const double size = std::abs(lambda);
        if (-lambda.real() < 0.5 * size) {
            fastest = std::max(fastest, std::min(size, 5.0 * low_pass_rad_s));
        }
    }
    return facts(integrator).steps_in_band * fastest * mesh_period_s / (2.0 * std::numbers::pi);
}

}  // namespace gearpod::lockstep
