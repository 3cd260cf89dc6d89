// Prints the physical effects of a scene for `describe`: effects simulated and effects omitted.
#pragma once

#include <string>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

void print_heading(const char* text);
void print_entry(const char* name, const std::string& value);

void print_effects(const Scene& scene);

}  // namespace gearpod::mc
