// Measures for `describe` which optional effects a study calls for.
#pragma once

#include "mc/plan/planner.hpp"

namespace gearpod::mc {

// Prints one entry for each optional effect: its computing time, and whether it changes a feature
// by more than numerics.tolerance, or 1 % without it. Uses the study's own solver setting, short
// records where every mesh period is integrated, and about `seconds` of processor time. May throw
// machine::Cancelled and SceneError. `span`, `mesh_frequency_Hz`: those of any plan of the study.
void print_effect_changes(const Planner& planner, const signals::SpanLayout& span,
                          double mesh_frequency_Hz, double seconds);

}  // namespace gearpod::mc
