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

}  // namespace gearpod::lockstep
