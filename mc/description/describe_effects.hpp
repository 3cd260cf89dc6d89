// Prints the physical effects of a scene for `describe`: effects simulated and effects omitted.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

void print_effects(const Scene& scene);

}  // namespace gearpod::mc
