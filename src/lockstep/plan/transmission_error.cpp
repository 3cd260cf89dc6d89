#include "lockstep/plan/transmission_error.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace gearpod::lockstep {

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
    assert(errors.size() == static_cast<std::size_t>(pairs.pairs()));
    nodes.error.resize(nodes.stiffness.size());
    nodes.error_rate.resize(nodes.stiffness.size());
    const double sense = pairs.reversed ? -1.0 : 1.0;
    std::size_t at = 0;
    for (const Step& step : grid.steps) {
        for (const double node : grid.stage_nodes) {
            const double phase = step.phase + node * step.length;
            for (int pair = 0; pair < nodes.pairs; ++pair, ++at) {
                const ErrorValue value = error_at(errors[static_cast<std::size_t>(pair)],
                                                  sense * (phase - pairs.pitch_phase(pair)));
                nodes.error[at] += value.error;
                nodes.error_rate[at] += sense * value.rate;
            }
        }
    }
}

void add_relief(const PairSet& pairs, const PhaseGrid& grid,
                std::span<const stiffness::LoadedMesh* const> loaded, StiffnessNodes& nodes) {
    assert(loaded.size() == static_cast<std::size_t>(pairs.pairs()));
    nodes.error.resize(nodes.stiffness.size());
    nodes.error_rate.resize(nodes.stiffness.size());
    std::size_t at = 0;
    for (const Step& step : grid.steps) {
        for (const double node : grid.stage_nodes) {
            for (int pair = 0; pair < nodes.pairs; ++pair, ++at) {
                // Since an engagement began; reversed, until one ends.
                const double start = pairs.start[static_cast<std::size_t>(pair)];
                const double ends = pairs.curve(pair).contact_ratio();
                const auto position = [&](double phase) {
                    return pairs.reversed ? ends - (phase - start) : phase - start;
                };
                const double inside = position(step.phase + 0.5 * step.length);
                const double tau = position(step.phase + node * step.length);
                const double period = std::floor(inside);
                const stiffness::LoadedMesh& mesh = *loaded[static_cast<std::size_t>(pair)];
                nodes.error[at] += mesh.error(tau - period, inside - period);
                nodes.error_rate[at] +=
                    (pairs.reversed ? -1.0 : 1.0) * mesh.error_rate(tau - period, inside - period);
            }
        }
    }
}

}  // namespace gearpod::lockstep
