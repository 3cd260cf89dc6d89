#include "lockstep/steps/instability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/dense_algebra.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/steps/step_limit.hpp"
#include "lockstep/tile/mesh_integrator.hpp"
#include "lockstep/tile/rigid_rotation.hpp"

namespace gearpod::lockstep {
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
    for (std::size_t lane = 0; lane < kUnitMotions; ++lane) {
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
        for (int lane = 0; lane < kUnitMotions && first + lane < ends.cols(); ++lane) {
            for (Eigen::Index d = 0; d < n; ++d) {
                const auto at = static_cast<std::size_t>(d * kUnitMotions + lane);
                ends(d, first + lane) = rate * state.q[at];
                ends(n + d, first + lane) = state.v[at];
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
            for (std::size_t pair = 0; pair < pairs; ++pair) {
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
