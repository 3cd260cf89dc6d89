// Pilot computation that chooses the time steps of a whole ensemble. It integrates a tile of the
// ensemble's gearboxes over the healthy periodic orbit and one passage of the fault to find where
// steps may be long. The resulting grid is fixed and serves all lanes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/steps/graded_grid.hpp"

namespace gearpod::lockstep {

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
