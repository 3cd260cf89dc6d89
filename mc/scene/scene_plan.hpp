// How a study's gearboxes are marched: integrator, steps and samples, and the stiffness at their
// nodes. How closely orbits settle has no part in it: scenes that differ in that alone share one.
#pragma once

#include <memory>
#include <optional>

#include "lockstep/plan/march.hpp"
#include "mc/scene/grid.hpp"
#include "mc/scene/scene_stiffness.hpp"
#include "mc/scene/stepping.hpp"

namespace gearpod::mc {

struct ScenePlan {
    lockstep::MarchPlan march;
    Stepping stepping;
    // How a pilot calibrated the steps, if one did.
    std::optional<Calibration> calibration;
    int te_samples = 0;  // of the encoders in a mesh period
};

// Throws SceneError.
ScenePlan make_plan(const Study& study, const Drive& drive, const SceneStiffness& stiffness);

}  // namespace gearpod::mc
