// Prints the gearbox of a scene for `describe`: teeth, meshes, speeds, torques, fault sizes.
#pragma once

#include <string>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

void print_gearbox(const Scene& scene);

// Contact ratio on the nominal path, its parts for helical teeth, and the time that a tooth pair
// may touch if corner contact extends the path.
std::string contact_ratio_text(const stiffness::MeshStiffness& mesh);

}  // namespace gearpod::mc
