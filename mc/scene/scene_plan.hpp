// Integration plan of a study's gearboxes: integrator, steps and samples, and the stiffness at
// their nodes. It does not depend on the convergence tolerance, so scenes that differ only in that
// share one plan.
#pragma once

#include <memory>
#include <optional>

#include "lockstep/plan/integration_plan.hpp"
#include "mc/scene/grid.hpp"
#include "mc/scene/scene_stiffness.hpp"
#include "mc/scene/stepping.hpp"

namespace gearpod::mc {

struct ScenePlan {
    lockstep::IntegrationPlan integration;
    Stepping stepping;
    // Calibration of the steps on a pilot sample; empty if there was none.
    std::optional<Calibration> calibration;
    int te_samples = 0;  // number of encoder samples per mesh period
};

// Throws SceneError.
ScenePlan make_plan(const Study& study, const Sampler& sampler, const Drivetrain& drivetrain,
                    const SceneStiffness& stiffness);

}  // namespace gearpod::mc
