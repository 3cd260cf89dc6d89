// Measures for `describe` which optional effects the scene calls for.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Prints one entry for each optional effect: its computing time, and whether it changes a feature
// by more than numerics.tolerance, or 1 % without it. Uses the study's own solver setting, short
// records where every mesh period is integrated, and about `seconds` of processor time. May throw
// machine::Cancelled and SceneError. `chosen`: scene of the study with any numerics.
void print_effect_changes(const Study& study, const Scene& chosen, double seconds);

}  // namespace gearpod::mc
