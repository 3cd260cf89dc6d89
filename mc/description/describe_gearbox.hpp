// What `describe` says of a scene's gearbox: teeth, meshes, speeds, torques, sizes of the fault.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

void print_gearbox(const Scene& scene);

}  // namespace gearpod::mc
