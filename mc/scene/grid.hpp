// Phase grid of a study: uniform steps, or graded steps calibrated on a pilot sample of its
// gearboxes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lockstep/steps/step_pilot.hpp"
#include "mc/scene/stepping.hpp"

namespace gearpod::mc {

// Result of calibrating the steps on a pilot sample.
struct Calibration {
    double signal_error = 0.0;
    lockstep::Grading grading;
};

struct SceneGrid {
    lockstep::PhaseGrid grid;
    std::optional<Calibration> calibration;  // empty for uniform steps
};

// Chooses the phase grid. `transitions`: phases at which steps must end. `pilot` is called only if
// the study requests graded steps. Throws SceneError.
SceneGrid choose_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions,
                      const std::function<lockstep::Pilot()>& pilot);

}  // namespace gearpod::mc
