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

// Longest allowed step as a function of the phase in the mesh period.
class StepProfile {
  public:
    // One entry for each step, ascending phases.
    StepProfile(std::vector<double> phases, std::vector<double> longest)
        : phases_(std::move(phases)), longest_(std::move(longest)) {}

    // Shortest of the longest allowed steps within [start, end), mesh periods.
    double longest_step(double start, double end) const;

  private:
    std::vector<double> phases_, longest_;
};

// Profile estimated from steps on `grid` with an integrator that estimates its own error.
// With these steps the estimate stays within `tolerance` of the largest position and of the largest
// velocity. It is the largest over lanes, mesh periods and degrees of freedom. It grows with the
// third power of the step.
StepProfile estimated_profile(const Pilot& pilot, const PhaseGrid& grid, double tolerance);

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
