// What a pilot's signals and features converge to: two independent methods, each with steps halved
// until both agree.
#pragma once

#include <limits>
#include <string>

#include "mc/numerics/pilot.hpp"
#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

struct ReferenceRequest {
    double agreement = 1e-8;
    double settle_tolerance = 1e-11;
    // No march of more steps, over all mesh periods of the pilot's tile.
    double most_tile_steps = 2e7;
    // Processor time: no march that would end later.
    double seconds = std::numeric_limits<double>::infinity();
};

struct Reference {
    // Extrapolated (Richardson) where halving the steps shows the method's order.
    PilotRecord record;
    Rung first, second;        // the two that agree best, at their finest; `record` is the first's
    double first_order = 0.0;  // observed on the sensor signal; 0: not extrapolated
    double second_order = 0.0;
    PilotError agreement;  // of the second with the first
    bool reached = false;  // the agreement asked for
};

// Signals to `agreement`. All methods march with their own steps and half of them; the two that
// then promise to agree soonest, by their orders and the cost of their steps, go on. Throws
// SceneError if no two methods march the study.
Reference converged_reference(const Study& study, const Pilot& pilot,
                              const ReferenceRequest& request);

// The same by one method alone, against itself with half the steps: features to `agreement`. For
// choosing how to run, where a wrong method would show in every gearbox anyway. The integrator is
// the study's own.
Reference converged_by_itself(const Study& study, const Pilot& pilot,
                              const ReferenceRequest& request);

}  // namespace gearpod::mc
