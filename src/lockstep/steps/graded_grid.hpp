// Phase grids with steps adapted to the response: short after a contact transition, where it
// vibrates, and long where it follows the stiffness smoothly. They have few distinct lengths,
// because integrators store coefficients for each (PhaseGrid::lengths).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Step lengths in mesh periods. At a distance `phase` after the latest transition, a step is at
// most max(first, growth * phase), and never more than `longest`.
struct Grading {
    double first = 0.0;
    double growth = 0.0;
    double longest = 0.0;
};

// Longest step allowed at the distance `since` after the latest transition.
double longest_step(const Grading& grading, double since);

// Grid with steps of `first` times a power of two from each transition to the next. The last one
// before a transition, or before the end of the mesh period, has the remaining length. Samples may
// lie inside steps. Throws std::invalid_argument if samples < 1 or the grading is not positive.
PhaseGrid make_graded_grid(int samples, std::span<const double> transitions,
                           const Grading& grading);

// Phase since the latest transition; infinite without transitions.
double since_transition(std::span<const double> transitions, double phase);

// Pilot computation that chooses the time steps of a whole ensemble. It integrates a tile of the
// ensemble's gearboxes over the healthy periodic orbit and one passage of the fault to find where
// steps may be long. The resulting grid is fixed and serves all lanes.

inline constexpr int kPilotLanes = 8;

struct Pilot {
    std::vector<dynamics::GearboxInputs> inputs;  // kPilotLanes gearboxes
    FaultCurves faults;
    int convergence_meshes = 1;  // mesh periods integrated to reach the periodic orbit
    // Makes the plan for a grid: integrator, layout and stiffness at the grid's stage nodes.
    std::function<IntegrationPlan(PhaseGrid)> plan;
};

struct GradedChoice {
    PhaseGrid grid;
    Grading grading;
    double error = 0.0;  // of the pilot's signals
    // true if the error is within the tolerance; otherwise `grid` is the finest one tried
    bool reached = false;
};

// Grid with the fewest steps among gradings made from `step` (mesh periods). Its sensor signals and
// transmission errors lie within `tolerance` (relative rms, worst lane) of those with uniform steps
// half as long. If even uniform steps exceed the tolerance, `step` is halved a few times.
GradedChoice choose_grading(const Pilot& pilot, double step, double tolerance,
                            const std::function<PhaseGrid(const Grading&)>& grid_of);

}  // namespace gearpod::lockstep
