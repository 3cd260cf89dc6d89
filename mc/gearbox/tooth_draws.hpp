// The errors of a gearbox's teeth: waves, eccentricity, scatter and slopes of every gear's flanks.
#pragma once

#include <optional>
#include <span>

#include "lockstep/plan/tooth_errors.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// `inputs` holds one gearbox a lane; lanes beyond `ids` repeat the last of them. A gearbox's draws
// depend on nothing but itself. None without tooth errors.
std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const GearboxId> ids,
                                                       std::span<const InstanceInputs> inputs);

}  // namespace gearpod::mc
