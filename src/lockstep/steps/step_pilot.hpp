// A pilot chooses the steps of a whole ensemble: a tile of its gearboxes marches the healthy orbit
// and one passage of the fault, and tells where steps may be long. What it finds is frozen: one
// grid serves all lanes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/march.hpp"
#include "lockstep/steps/graded_grid.hpp"

namespace gearpod::lockstep {

inline constexpr int kPilotLanes = 8;

struct Pilot {
    std::vector<dynamics::GearboxInputs> inputs;  // kPilotLanes gearboxes
    FaultCurves faults;
    int settle_meshes = 1;  // mesh periods marched before the orbit counts as reached
    // The plan of a grid: integrator, layout and stiffness at the grid's stage nodes.
    std::function<MarchPlan(PhaseGrid)> plan;
};

// The longest steps that an estimate allows along the mesh period.
class StepProfile {
  public:
    // One entry for each of the steps, ascending phases.
    StepProfile(std::vector<double> phases, std::vector<double> longest)
        : phases_(std::move(phases)), longest_(std::move(longest)) {}

    // Mesh periods; the shortest of those within [start, end).
    double longest_step(double start, double end) const;

  private:
    std::vector<double> phases_, longest_;
};

// From steps on `grid` with an integrator that estimates its own error (bs3): the steps at which
// the estimate, largest over lanes, mesh periods and degrees of freedom, stays within `tolerance`
// of the largest position and of the largest velocity. An estimate grows with the step's third
// power.
StepProfile estimated_profile(const Pilot& pilot, const PhaseGrid& grid, double tolerance);

struct GradedChoice {
    PhaseGrid grid;
    Grading grading;
    double error = 0.0;    // of the pilot's signals
    bool reached = false;  // whether that is within the tolerance; if not, the finest grid tried
};

// The grid of fewest steps, among gradings made from `step` (mesh periods), whose sensor signals
// and transmission errors lie within `tolerance` (rms, relative, the worst lane) of those with
// uniform steps half as long. If not even uniform steps do, `step` is halved, a few times.
GradedChoice choose_grading(const Pilot& pilot, double step, double tolerance,
                            const std::function<PhaseGrid(const Grading&)>& grid_of);

}  // namespace gearpod::lockstep
