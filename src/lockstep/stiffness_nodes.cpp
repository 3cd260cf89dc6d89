#include "lockstep/stiffness_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/effects/mesh_damping.hpp"

namespace gearpod::lockstep {
namespace {

// Adds the stiffness of the tooth pair that began to engage at phase `start` to column `pair`.
void add_tooth_pair(StiffnessNodes& nodes, const PhaseGrid& grid, const PairSet& pairs, int pair,
                    double start) {
    const auto& curve = pairs.curve(pair);
    const ToothPositions positions = tooth_positions(grid, 0.0, start, curve.contact_ratio());
    std::vector<double> k(positions.tau.size());
    pairs.tooth_pair(curve, curve.contact_ratio(), positions.tau, k);
    const int stages = static_cast<int>(grid.stage_nodes.size());
    for (int i = positions.first_step * stages; i < positions.last_step * stages; ++i) {
        nodes.stiffness[static_cast<std::size_t>(i * nodes.pairs + pair)] +=
            k[static_cast<std::size_t>(i)];
    }
}

}  // namespace

double PairSet::mesh(int pair, double phase) const {
    const double since = phase - start[static_cast<std::size_t>(pair)];
    return curve(pair).mesh(reversed ? curve(pair).contact_ratio() - since : since);
}

double phase_in_period(double phase) {
    return phase - std::floor(phase);
}

std::vector<double> contact_transitions(const PairSet& pairs) {
    std::vector<double> phases;
    for (int i = 0; i < pairs.pairs(); ++i) {
        const double start = pairs.start[static_cast<std::size_t>(i)];
        phases.push_back(phase_in_period(start));
        phases.push_back(phase_in_period(start + pairs.curve(i).contact_ratio()));
    }
    std::sort(phases.begin(), phases.end());
    return phases;
}

ToothPositions tooth_positions(const PhaseGrid& grid, double mesh, double start,
                               double contact_ratio) {
    ToothPositions positions;
    positions.tau.reserve(grid.steps.size() * grid.stage_nodes.size());
    const auto engaged = [&](const Step& step) {
        // A step lies wholly inside or outside the engagement; its middle decides.
        const double middle = mesh + step.phase + 0.5 * step.length - start;
        return middle > 0.0 && middle < contact_ratio;
    };
    const auto first = std::find_if(grid.steps.begin(), grid.steps.end(), engaged);
    const auto last = std::find_if_not(first, grid.steps.end(), engaged);
    positions.first_step = static_cast<int>(first - grid.steps.begin());
    positions.last_step = static_cast<int>(last - grid.steps.begin());
    for (const Step& step : grid.steps) {
        for (const double part : grid.stage_nodes) {
            const double tau = mesh + step.phase + part * step.length - start;
            positions.tau.push_back(std::clamp(tau, 0.0, contact_ratio));
        }
    }
    return positions;
}

StiffnessNodes tabulate(const PairSet& pairs, const PhaseGrid& grid,
                        dynamics::MeshDamping damping) {
    StiffnessNodes nodes;
    nodes.pairs = pairs.pairs();
    nodes.stiffness.assign(
        grid.steps.size() * grid.stage_nodes.size() * static_cast<std::size_t>(nodes.pairs), 0.0);
    for (int pair = 0; pair < nodes.pairs; ++pair) {
        const auto& curve = pairs.curve(pair);
        // Tooth pairs that began in this or in an earlier mesh period and are still in contact.
        const int earlier = static_cast<int>(std::ceil(curve.contact_ratio()));
        for (int age = 0; age <= earlier; ++age) {
            add_tooth_pair(nodes, grid, pairs, pair,
                           pairs.start[static_cast<std::size_t>(pair)] - age);
        }
    }
    nodes.damping_shape.resize(nodes.stiffness.size());
    dynamics::with_mesh_damping(damping, [&](auto law) {
        std::transform(nodes.stiffness.begin(), nodes.stiffness.end(), nodes.damping_shape.begin(),
                       [&](double k) { return law.shape(k); });
    });
    return nodes;
}

}  // namespace gearpod::lockstep
