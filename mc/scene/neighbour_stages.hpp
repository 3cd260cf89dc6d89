// Scenes of the neighbouring stages of a study (NeighbourStage), and their gearboxes.
#pragma once

#include <vector>

#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// In the order of the study. Throws SceneError if a stage cannot run steadily, if its common shaft
// has another speed, or if its low-pass differs.
std::vector<Scene> stage_scenes(const Study& study);

// Gearbox of stage number `stage` next to the study's gearbox of a record, without the stage's
// fault. Speed and torque differ from their nominal values by the same factors as here.
Realization stage_gearbox(const Scene& scene, std::size_t stage, const Realization& record);
// Size of the stage's fault in records of another fault.
double stage_fault_size(const Scene& scene, std::size_t stage, const GearboxId& id);

}  // namespace gearpod::mc
