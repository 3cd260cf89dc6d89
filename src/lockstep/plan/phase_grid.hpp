// Grid of steps over a mesh period, with few distinct lengths.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace gearpod::lockstep {

// Phase tolerance, mesh periods: closer transitions share a node. It is far below any step length
// and far above the rounding error of phases.
inline constexpr double kSamePhase = 1e-12;

// Index of `length` in `lengths`; appends it if it is new.
inline int find_or_add(std::vector<double>& lengths, double length) {
    const auto found = std::find_if(lengths.begin(), lengths.end(), [&](double known) {
        return std::abs(known - length) < kSamePhase;
    });
    if (found != lengths.end()) {
        return static_cast<int>(found - lengths.begin());
    }
    lengths.push_back(length);
    return static_cast<int>(lengths.size()) - 1;
}

// Time steps of one mesh period, the same for all lanes. A step boundary lies on every contact
// transition of every pair, so that integrators keep their order across the stiffness jumps.
// Usually one also lies on every sample; a sample inside a step is interpolated.
struct Step {
    double phase = 0.0;   // start, mesh periods
    double length = 0.0;  // mesh periods
    int kind = 0;         // index into PhaseGrid::lengths
    int sample = -1;      // sample taken at the start of the step, or -1
    int inside = 0;       // samples inside the step, after its start
    int first_inside = 0;
};

struct PhaseGrid {
    int samples = 0;              // per mesh period, at phases i / samples
    std::vector<Step> steps;      // ascending phase, covering [0, 1)
    std::vector<double> lengths;  // distinct step lengths, mesh periods
    // Positions within a step at which the integrator's stages need the stiffness, ascending in [0,
    // 1]. At 0 it is the limit from above, at 1 the limit from below. The default is the classical
    // Runge-Kutta method.
    std::vector<double> stage_nodes{0.0, 0.5, 1.0};
};

// Grid of at least `steps_per_mesh` equal steps, rounded up to a multiple of `samples`, then split
// at `transitions` (phases in [0, 1)). Throws std::invalid_argument if samples < 1 or
// steps_per_mesh < 1.
PhaseGrid make_phase_grid(int samples, int steps_per_mesh, std::span<const double> transitions);

}  // namespace gearpod::lockstep
