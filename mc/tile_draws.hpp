// What is drawn for a gearbox beside its inputs: the phases of interfering tones, and the pitch
// errors of its teeth. As with the inputs, a gearbox's draws depend on nothing but itself.
#pragma once

#include <optional>
#include <span>

#include "lockstep/tooth_errors.hpp"
#include "mc/sampling.hpp"
#include "mc/scene.hpp"
#include "signals/tones.hpp"

namespace gearpod::mc {

// `inputs` holds one gearbox a lane; lanes beyond `ids` repeat the last of them.

// Nothing keeps step with the tones: each begins anywhere in its turn. Empty without tones.
signals::Tones draw_tones(const Scene& scene, std::span<const GearboxId> ids,
                          std::span<const InstanceInputs> inputs);

// Normal pitch errors of every flank of every gear. None without pitch errors.
std::optional<lockstep::ToothErrors> draw_tooth_errors(const Scene& scene,
                                                       std::span<const GearboxId> ids,
                                                       std::span<const InstanceInputs> inputs);

}  // namespace gearpod::mc
