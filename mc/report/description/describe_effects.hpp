// Parts of a gearbox without damping.
#pragma once

#include <string>

#include "mc/plan/planner.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Names the vibrating parts whose damping is 0 in every gearbox, for example "bearings of sun and
// ring, support of the ring". Empty if every part has damping, or in quasi-static studies.
std::string undamped(const Study& study);

// Prints the physical effects of a scene for `describe`: effects simulated and effects omitted.

void print_effects(const Scene& scene);

// Measures for `describe` which optional effects the scene calls for.

// Prints one entry for each optional effect: its computing time, and whether it changes a feature
// by more than numerics.tolerance, or 1 % without it. Uses the study's own solver setting, short
// records where every mesh period is integrated, and about `seconds` of processor time. May throw
// machine::Cancelled and SceneError. `span`, `mesh_frequency_Hz`: those of any plan of the study.
void print_effect_changes(const Planner& planner, const signals::SpanLayout& span,
                          double mesh_frequency_Hz, double seconds);

}  // namespace gearpod::mc
