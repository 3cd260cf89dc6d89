// Measures for `describe` which optional effects the scene calls for.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Prints one entry for each optional effect: its computing time, and whether it changes a feature
// by more than numerics.tolerance, or 1 % without it. Uses the study's own solver setting, short
// records where every mesh period is integrated, and about `seconds` of processor time. May throw
// machine::Cancelled.
void print_effect_changes(const Study& study, double seconds);

}  // namespace gearpod::mc
