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

// Throws SceneError if a tone of a shaft, or the impulses of a bearing, are not below half the
// sampling rate.
void check_shaft_orders(const Study& study, const Drivetrain& drivetrain, int samples_per_mesh);

}  // namespace gearpod::mc
