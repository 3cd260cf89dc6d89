// One-sentence summary of a study's modelling assumptions, for readers of its results.
#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Text that begins "These results hold for identical teeth, ...": the idealizations of the
// simulated gearboxes, the inputs that do not vary, and their effect on the results. `lives`: for
// the lives of gearboxes with a growing crack, otherwise for a run, in which no crack grows. Empty
// for a study without gears.
std::string assumptions(const Study& study, bool lives);

}  // namespace gearpod::mc
