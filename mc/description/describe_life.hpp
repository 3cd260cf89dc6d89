// What `describe` says of lives: what is drawn for a gearbox, what for each of its records.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Nothing of a study without lives.
void print_life(const Scene& scene);

}  // namespace gearpod::mc
