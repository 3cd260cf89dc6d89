// Checks that a scene's integration plan can resolve the variable excitation of its gearboxes.
#pragma once

#include "lockstep/plan/integration_plan.hpp"
#include "mc/scene/drivetrain.hpp"
#include "mc/scene/sampling.hpp"

namespace gearpod::mc {

// Throws SceneError if kernels are missing, or if steps or samples are too coarse for a
// fluctuation.
void check_excitation_resolved(const Study& study, const Sampler& sampler,
                               const Drivetrain& drivetrain, const lockstep::IntegrationPlan& plan);

}  // namespace gearpod::mc
