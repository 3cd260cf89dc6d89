// Prints the gearbox of a scene for `describe`: teeth, meshes, speeds, torques, fault sizes.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

void print_gearbox(const Scene& scene);

}  // namespace gearpod::mc
