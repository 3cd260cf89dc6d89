// Prints the life simulation for `describe`: random inputs of a gearbox and of each of its records.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Prints nothing for a study without lives.
void print_life(const Scene& scene);

}  // namespace gearpod::mc
