// Phase grid of a study: uniform steps, or graded steps calibrated on a pilot sample of its
// gearboxes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/plan/stepping.hpp"

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

// Checks that a scene's integration plan can resolve the variable excitation of its gearboxes.

// Throws SceneError if kernels are missing, or if steps or samples are too coarse for a
// fluctuation.
void check_excitation_resolved(const Study& study, const Sampler& sampler,
                               const GearboxPlan& gearbox, const lockstep::IntegrationPlan& plan);

// Throws SceneError if a tone of a shaft, or the impulses of a bearing, are not below half the
// sampling rate.
void check_shaft_orders(const Study& study, const Drivetrain& drivetrain, int samples_per_mesh);

// Integration plan of a study's gearboxes: integrator, steps and samples, and the stiffness at
// their nodes. It does not depend on the convergence tolerance, so scenes that differ only in that
// share one plan.

struct ScenePlan {
    lockstep::IntegrationPlan integration;
    Stepping stepping;
    // Calibration of the steps on a pilot sample; empty if there was none.
    std::optional<Calibration> calibration;
    int te_samples = 0;  // number of encoder samples per mesh period
};

// Throws SceneError.
ScenePlan make_plan(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox);

}  // namespace gearpod::mc
