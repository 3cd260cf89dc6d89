// The phase grid of a study: uniform steps, or steps that a pilot of its gearboxes calibrates.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lockstep/steps/step_pilot.hpp"
#include "mc/scene/stepping.hpp"

namespace gearpod::mc {

// How a pilot came to the steps.
struct Calibration {
    // Graded by the signals' error (all integrators but bs3): that error and the grading.
    double signal_error = 0.0;
    lockstep::Grading grading;
    bool estimated = false;  // by the error that bs3 estimates of its own steps
};

struct SceneGrid {
    lockstep::PhaseGrid grid;
    std::optional<Calibration> calibration;  // none for steps without a pilot
};

// `transitions`: where steps must end. `pilot` is made only if the study asks for calibrated steps.
// Throws SceneError.
SceneGrid choose_grid(const Study& study, const Stepping& stepping, int samples,
                      const std::vector<double>& transitions,
                      const std::function<lockstep::Pilot()>& pilot);

}  // namespace gearpod::mc
