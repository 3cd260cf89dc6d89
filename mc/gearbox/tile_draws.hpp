// What is drawn for a gearbox beside its inputs: the phases of interfering tones, and the errors of
// its teeth (tooth_draws.hpp). As with the inputs, a gearbox's draws depend on nothing but itself.
#pragma once

#include <optional>
#include <span>

#include "lockstep/plan/excitation.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/noise/tones.hpp"

namespace gearpod::mc {

// `inputs` holds one gearbox a lane; lanes beyond `ids` repeat the last of them.

// The gearbox in a lane.
inline const GearboxId& id_of_lane(std::span<const GearboxId> ids, std::size_t lane) {
    return ids[lane < ids.size() ? lane : ids.size() - 1];
}

// Nothing keeps step with the tones: each begins anywhere in its turn. Empty without tones.
signals::Tones draw_tones(const Scene& scene, std::span<const GearboxId> ids,
                          std::span<const InstanceInputs> inputs);

// Mesh periods that are marched before the first recorded one: those in which what its teeth or its
// drive excite when they set in decays to the settling tolerance.
int run_in_meshes(const Scene& scene);

// Gravity, and the fluctuations of torque and speed; their noise has knots from before any run-in,
// the same however long it is, to behind the last mesh of scene.signal_meshes(), and begins
// anywhere between two knots. None if nothing drives the gearboxes unevenly.
std::optional<lockstep::Excitation> draw_excitation(const Scene& scene,
                                                    std::span<const GearboxId> ids,
                                                    std::span<const InstanceInputs> inputs);

}  // namespace gearpod::mc
