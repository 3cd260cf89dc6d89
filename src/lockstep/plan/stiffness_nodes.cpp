#include "lockstep/plan/stiffness_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "machine/contracts.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/positions.hpp"

namespace gearpod::lockstep {
namespace {

// Converts the positions of a reversed contact to forward ones; `last` is the position at which the
// contact ends.
void mirror(StepPositions& steps, double last) {
    for (auto* positions : {&steps.node, &steps.middle}) {
        std::reverse(positions->begin(), positions->end());
        for (double& position : *positions) {
            position = last - position;
        }
    }
}

// Calls total(positions, inside, values) for each run of steps that lie in the same stretch between
// transitions or jumps, and returns all values.
template <class Total>
std::vector<double> by_stretches(const StepPositions& steps, std::span<const double> transitions,
                                 std::span<const double> jumps, const Total& total) {
    std::vector<double> values(steps.node.size()), positions(steps.node.size());
    const std::size_t count = steps.middle.size();
    const std::size_t nodes = count > 0 ? steps.node.size() / count : 0;
    for (std::size_t step = 0; step < count;) {
        const double inside = steps.middle[step];
        const auto stretch = stiffness::stretch_around(transitions, jumps, inside);
        const std::size_t first = step * nodes;
        while (step < count && steps.middle[step] < stretch.end) {
            ++step;
        }
        const std::size_t size = step * nodes - first;
#pragma omp simd
        for (std::size_t i = first; i < first + size; ++i) {
            const double node = steps.node[i];
            const double begun = node < stretch.begin ? stretch.begin : node;
            positions[i] = begun > stretch.end ? stretch.end : begun;
        }
        total(std::span<const double>(positions).subspan(first, size), inside,
              std::span<double>(values).subspan(first, size));
    }
    return values;
}

// Same as by_stretches(), for either direction of contact; `last` is the position at which the
// contact ends.
template <class Total>
std::vector<double> in_order(const stiffness::MeshStiffness& healthy, double last,
                             const std::vector<double>& jumps, bool reversed,
                             const StepPositions& steps, const Total& total) {
    if (!reversed) {
        return by_stretches(steps, healthy.transitions(), jumps, total);
    }
    StepPositions mirrored = steps;
    mirror(mirrored, last);
    std::vector<double> values = by_stretches(mirrored, healthy.transitions(), jumps, total);
    std::reverse(values.begin(), values.end());
    return values;
}

// Totals of a mesh, which is `healthy` or `healthy` with a fault.
template <class Mesh>
PairTotals pair_totals(const stiffness::MeshStiffness& healthy, const Mesh& mesh, double last,
                       const std::vector<double>& jumps, bool reversed,
                       const StepPositions& steps) {
    const auto by = [&](auto total) {
        return in_order(healthy, last, jumps, reversed, steps,
                        [&](auto positions, double inside, auto values) {
                            (mesh.*total)(positions, inside, values);
                        });
    };
    PairTotals totals{by(&Mesh::total), {}};
    totals.paths = healthy.has_gaps() ? by(&Mesh::path_total) : totals.all;
    return totals;
}

}  // namespace

double PairSet::pitch_phase(PairId pair) const {
    const auto& m = curve(pair);
    return start[pair] + (reversed ? m.contact_ratio() - m.pitch_position() : m.pitch_position());
}

double PairSet::total(PairId pair, double phase) const {
    const auto& m = curve(pair);
    const double since = phase - start[pair];
    return reversed ? total_at(m, m.contact_ratio() - since, stiffness::Limit::from_below)
                    : total_at(m, since, stiffness::Limit::from_above);
}

double phase_in_period(double phase) {
    return phase - std::floor(phase);
}

std::vector<double> contact_transitions(const PairSet& pairs) {
    std::vector<double> phases;
    for (PairId i{0}; i < pairs.pairs(); ++i) {
        const auto& mesh = pairs.curve(i);
        const double start = pairs.start[static_cast<std::size_t>(i)];
        for (const double transition : mesh.transitions()) {
            phases.push_back(phase_in_period(
                start + (pairs.reversed ? mesh.contact_ratio() - transition : transition)));
        }
    }
    std::sort(phases.begin(), phases.end());
    return phases;
}

StepPositions overlapping_steps(const PhaseGrid& grid, double mesh, double start, double duration) {
    // A step lies entirely inside or outside the passage; its middle decides.
    const auto middle = [&](const Step& step) {
        return mesh + step.phase + 0.5 * step.length - start;
    };
    const auto overlaps = [&](const Step& step) {
        return middle(step) > 0.0 && middle(step) < duration;
    };
    const auto first = std::find_if(grid.steps.begin(), grid.steps.end(), overlaps);
    const auto last = std::find_if_not(first, grid.steps.end(), overlaps);
    StepPositions positions;
    positions.first_step = static_cast<int>(first - grid.steps.begin());
    positions.last_step = static_cast<int>(last - grid.steps.begin());
    positions.node.reserve(static_cast<std::size_t>(last - first) * grid.stage_nodes.size());
    for (auto step = first; step != last; ++step) {
        positions.middle.push_back(middle(*step));
        for (const double part : grid.stage_nodes) {
            positions.node.push_back(mesh + step->phase + part * step->length - start);
        }
    }
    return positions;
}

PairTotals healthy_totals(const stiffness::MeshStiffness& mesh, bool reversed,
                          const StepPositions& steps) {
    return pair_totals(mesh, mesh, mesh.contact_ratio(), {}, reversed, steps);
}

PairTotals faulty_totals(const stiffness::MeshStiffness& healthy,
                         const stiffness::FaultyMesh& faulty, bool reversed,
                         const StepPositions& steps) {
    return pair_totals(healthy, faulty, faulty.duration(), faulty.jumps(), reversed, steps);
}

StiffnessNodes tabulate(const PairSet& pairs, const PhaseGrid& grid,
                        dynamics::MeshDamping damping) {
    constexpr double kForever = std::numeric_limits<double>::infinity();
    StiffnessNodes nodes;
    nodes.pairs = pairs.pairs();
    const auto count = static_cast<std::size_t>(nodes.pairs);
    nodes.stiffness.resize(grid.steps.size() * grid.stage_nodes.size() * count);
    nodes.damping_shape.resize(nodes.stiffness.size());
    for (PairId pair{0}; pair < count; ++pair) {
        // Positions count from an engagement that starts before the mesh period.
        const StepPositions steps = overlapping_steps(grid, 0.0, pairs.start[pair] - 1.0, kForever);
        const PairTotals totals = healthy_totals(*pairs.mesh[pair], pairs.reversed, steps);
        dynamics::with_mesh_damping(damping, [&](auto law) {
            for (std::size_t i = 0; i < totals.all.size(); ++i) {
                nodes.stiffness[i * count + pair] = totals.all[i];
                nodes.damping_shape[i * count + pair] = law.shape(totals.paths[i]);
            }
        });
    }
    return nodes;
}

ErrorValue error_at(const MeshError& error, double x) {
    ErrorValue sum;
    for (std::size_t i = 0; i < error.amplitude_m.size(); ++i) {
        const double rate = 2.0 * std::numbers::pi * static_cast<double>(i + 1);
        const double phase = i < error.phase_rad.size() ? error.phase_rad[i] : 0.0;
        sum.error += error.amplitude_m[i] * std::sin(rate * x + phase);
        sum.rate += rate * error.amplitude_m[i] * std::cos(rate * x + phase);
    }
    return sum;
}

void add_errors(const PairSet& pairs, const PhaseGrid& grid, std::span<const MeshError> errors,
                StiffnessNodes& nodes) {
    EXPECTS(errors.size() == static_cast<std::size_t>(pairs.pairs()));
    nodes.error.resize(nodes.stiffness.size());
    nodes.error_rate.resize(nodes.stiffness.size());
    const double sense = pairs.reversed ? -1.0 : 1.0;
    std::size_t index = 0;
    for (const Step& step : grid.steps) {
        for (const double node : grid.stage_nodes) {
            const double phase = step.phase + node * step.length;
            for (PairId pair{0}; pair < nodes.pairs; ++pair, ++index) {
                const ErrorValue value =
                    error_at(errors[pair], sense * (phase - pairs.pitch_phase(pair)));
                nodes.error[index] += value.error;
                nodes.error_rate[index] += sense * value.rate;
            }
        }
    }
}

}  // namespace gearpod::lockstep
