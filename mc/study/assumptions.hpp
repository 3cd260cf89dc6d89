// What an answer takes for granted, in a sentence for whoever acts on it.
#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// "Holds for identical teeth, ...": what the gearboxes have that no real one has, what is not
// scattered, and what that does to the answer. Of its `lives`, or of a run, in which no crack grows.
// Empty for a study without gears.
std::string assumptions(const Study& study, bool lives);

}  // namespace gearpod::mc
