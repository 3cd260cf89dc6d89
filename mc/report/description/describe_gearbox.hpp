// Prints the gearbox of a scene for `describe`: teeth, meshes, speeds, torques, fault sizes.
#pragma once

#include <string>

#include "mc/plan/scene.hpp"

namespace gearpod::mc {

void print_gearbox(const Scene& scene);

// Contact ratio on the nominal path, its parts for helical teeth, and the time that a tooth pair
// may touch if corner contact extends the path.
std::string contact_ratio_text(const stiffness::MeshStiffness& mesh);

// Sensors of a study for `describe`: their paths, and what they pick up apart from the gearbox.

// Prints one entry for each. The gearbox must have accelerations.
void print_sensors(const Scene& scene);

}  // namespace gearpod::mc
