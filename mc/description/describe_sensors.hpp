// Sensors of a study for `describe`: their paths, and what they pick up apart from the gearbox.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Prints one entry for each. The gearbox must have accelerations.
void print_sensors(const Scene& scene);

}  // namespace gearpod::mc
