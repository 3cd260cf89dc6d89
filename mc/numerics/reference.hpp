// Reference solution of a pilot: two independent methods with their steps halved until both agree.
#pragma once

#include <limits>
#include <string>

#include "mc/numerics/pilot.hpp"
#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

struct ReferenceRequest {
    double agreement = 1e-8;
    double convergence_tolerance = 1e-11;
    // Largest number of steps of one integration, over all mesh periods of the pilot's tile.
    double most_tile_steps = 2e7;
    // Limit of the processor time, s: no integration is started that would end later.
    double seconds = std::numeric_limits<double>::infinity();
};

struct Reference {
    // Richardson-extrapolated if halving the steps shows the method's order.
    PilotRecord record;
    SolverSetting first,
        second;                // the two that agree best, at their finest; `record` is from `first`
    double first_order = 0.0;  // observed on the sensor signal; 0: not extrapolated
    double second_order = 0.0;
    PilotError agreement;  // error of the second relative to the first; empty without a second
    bool reached = false;  // true: the requested agreement was reached
};

// Reference with signals to `agreement`. All methods are integrated with their own steps and half
// of them. The two that are expected to agree at the lowest cost, judged by their orders and step
// costs, are refined further. Throws SceneError if no two methods can integrate the study.
Reference converged_reference(const Pilot& pilot, const Numerics& numerics,
                              const ReferenceRequest& request);

// Reference with features to `agreement` from one method, compared with itself at half the steps.
// Used to choose how to run, where a wrong method would be visible in every gearbox anyway. Uses
// the integrator of the study.
Reference self_converged_reference(const Pilot& pilot, const Numerics& numerics,
                                   const ReferenceRequest& request);

}  // namespace gearpod::mc
