#include "lockstep/steps/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "machine/contracts.hpp"

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

double slowest_decay_1_s(const dynamics::GearboxMatrices& m, const Eigen::VectorXd& rotation) {
    const dynamics::EigenPairs pairs = dynamics::eigen_pairs(state_matrix(m));
    const Eigen::Index n = rotation.size();
    const Eigen::VectorXcd weighted = (m.mass * rotation).cast<std::complex<double>>();
    std::vector<std::pair<double, Eigen::Index>>
        likeness;  // share of a mode's inertia that rotates
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const Eigen::VectorXcd shape = pairs.vectors.col(i).head(n);
        const double inertia = std::abs(shape.dot(m.mass * shape));
        likeness.emplace_back(std::norm(weighted.dot(shape)) / inertia, i);
    }
    constexpr std::size_t kRigid = 2;  // angle and speed
    std::ranges::partial_sort(likeness, likeness.begin() + kRigid, std::greater<>());
    double slowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = kRigid; i < likeness.size(); ++i) {
        const std::complex<double> lambda = pairs.values(likeness[i].second);
        const double size = std::abs(lambda);
        if (size >= rigid_rate(m) && lambda.real() <= 1e-9 * size) {
            slowest = std::min(slowest, std::max(0.0, -lambda.real()));
        }
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

namespace {

constexpr double kNoGrowth = 1.0 + 1e-5;
constexpr int kUnitMotions = 8;

std::vector<double> stiffest_nodes(const IntegrationPlan& plan) {
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    std::vector<double> stiffest(pairs, 0.0);
    for (std::size_t i = 0; i < plan.nodes.stiffness.size(); ++i) {
        stiffest[i % pairs] = std::max(stiffest[i % pairs], plan.nodes.stiffness[i]);
    }
    return stiffest;
}

bool step_too_long(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs) {
    if (!is_explicit(plan.integrator)) {
        return false;  // implicit methods are stable for any step
    }
    const double longest = *std::max_element(plan.grid.lengths.begin(), plan.grid.lengths.end());
    const auto matrices = dynamics::assemble(plan.layout, inputs, stiffest_nodes(plan));
    return longest * dynamics::mesh_period_s(inputs) >
           longest_stable_step(matrices, plan.integrator);
}

// Largest |eigenvalue| of a mesh period's map of (q, v), with the rigid rotation removed from q and
// v at its end.
double growth(const IntegrationPlan& plan, const Eigen::MatrixXd& mass,
              const Eigen::MatrixXd& map) {
    if (!map.allFinite()) {
        return std::numeric_limits<double>::infinity();
    }
    const Eigen::VectorXd turn = dynamics::rigid_rotation(plan.layout);
    const Eigen::VectorXd weighted = mass * turn;
    const Eigen::RowVectorXd rotation = (weighted / weighted.dot(turn)).transpose();
    const Eigen::Index n = turn.size();
    Eigen::MatrixXd kept = map;
    kept.topRows(n) -= (turn * (rotation * map.topRows(n))).eval();
    kept.bottomRows(n) -= (turn * (rotation * map.bottomRows(n))).eval();
    return dynamics::eigenvalues(kept).cwiseAbs().maxCoeff();
}

// Factor that scales displacements to the magnitude of velocities. Without it, the map's
// eigenvalues would lose as many digits as the vibration's rate has.
double velocity_scale(const dynamics::GearboxMatrices& m) {
    const double rate =
        std::sqrt((m.stiffness.diagonal().array() / m.mass.diagonal().array()).maxCoeff());
    return rate > 0.0 ? rate : 1.0;
}

// State of kUnitMotions gearboxes in which lane l has unit motion (first + l) - 1 of 2n. Index -1
// and indices past the last mean no displacement.
TileState unit_states(Eigen::Index n, int channels, int first, double rate) {
    const auto degrees = static_cast<std::size_t>(n);
    TileState state = zero_state(degrees, channels, kUnitMotions);
    for (LaneId lane{0}; lane < kUnitMotions; ++lane) {
        const std::size_t unit = static_cast<std::size_t>(first) + lane;
        if (unit >= 1 && unit <= degrees) {
            state.q[(unit - 1) * kUnitMotions + lane] = 1.0 / rate;
        } else if (unit > degrees && unit <= 2 * degrees) {
            state.v[(unit - 1 - degrees) * kUnitMotions + lane] = 1.0;
        }
    }
    return state;
}

// Map of (rate q, v) over a mesh period, computed by time integration. Column 0 is the motion from
// rest under the load, which is subtracted from the others.
Eigen::MatrixXd mesh_period_map(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs,
                                Eigen::Index n, double rate) {
    const std::vector<dynamics::GearboxInputs> alike(kUnitMotions, inputs);
    const auto mesh_integrator = make_mesh_integrator<kUnitMotions>(plan, alike);
    MeshRecord record = make_record(plan, kUnitMotions, false);
    Eigen::MatrixXd ends(2 * n, 2 * n + 1);
    for (int first = 0; first < ends.cols(); first += kUnitMotions) {
        TileState state = unit_states(n, plan.channels(), first, rate);
        (*mesh_integrator)({}, state, record);
        for (LaneId lane{0}; lane < kUnitMotions && first + lane < ends.cols(); ++lane) {
            for (Eigen::Index d = 0; d < n; ++d) {
                const auto index = static_cast<std::size_t>(d * kUnitMotions + lane);
                ends(d, first + lane) = rate * state.q[index];
                ends(n + d, first + lane) = state.v[index];
            }
        }
    }
    return ends.rightCols(2 * n).colwise() - ends.col(0);
}

}  // namespace

std::vector<double> mean_stiffness(const IntegrationPlan& plan) {
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    const std::size_t nodes = plan.grid.stage_nodes.size();
    std::vector<double> mean(pairs, 0.0);
    const double* stiffness = plan.nodes.stiffness.data();
    for (const Step& step : plan.grid.steps) {
        const double share = step.length / static_cast<double>(nodes);
        for (std::size_t node = 0; node < nodes; ++node, stiffness += pairs) {
            for (PairId pair{0}; pair < pairs; ++pair) {
                mean[pair] += share * stiffness[pair];
            }
        }
    }
    return mean;
}

bool above_critical_speed(const dynamics::GearboxLayout& layout,
                          const dynamics::GearboxInputs& inputs,
                          const std::vector<double>& mean_stiffness) {
    const auto m = dynamics::assemble(layout, inputs, mean_stiffness);
    if (m.centrifugal.isZero(0.0)) {
        return false;
    }
    // Scaled to unit masses, K must be at least W^2. The rigid rotation has no stiffness, so a much
    // larger one is added to it.
    const Eigen::VectorXd scale = m.mass.diagonal().cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd constrained =
        scale.asDiagonal() * (m.stiffness + m.centrifugal) * scale.asDiagonal();
    const Eigen::VectorXd turn = dynamics::rigid_rotation(layout).cwiseQuotient(scale).normalized();
    constrained += (1e3 * constrained.diagonal().cwiseAbs().maxCoeff()) * turn * turn.transpose();
    return !dynamics::positive_definite(constrained);
}

double growth_per_mesh(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs) {
    EXPECTS(!dynamics::separates(plan.mesh_law));
    const auto matrices = dynamics::assemble(plan.layout, inputs, mean_stiffness(plan));
    return growth(plan, matrices.mass,
                  mesh_period_map(in_double_precision(plan), inputs, matrices.mass.rows(),
                                  velocity_scale(matrices)));
}

Instability find_instability(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs) {
    if (above_critical_speed(plan.layout, inputs, mean_stiffness(plan))) {
        return Instability::rotating_frame;
    }
    if (step_too_long(plan, inputs)) {
        return Instability::step;
    }
    const bool linear = !dynamics::separates(plan.mesh_law);
    return linear && growth_per_mesh(plan, inputs) > kNoGrowth ? Instability::parametric
                                                               : Instability::none;
}

}  // namespace gearpod::lockstep
