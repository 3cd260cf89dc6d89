// Damping that a study leaves at 0.
#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// "bearings of sun and ring, support": what vibrates and has no damping of its own in any gearbox.
// Empty if everything has some, or nothing vibrates.
std::string undamped(const Study& study);

}  // namespace gearpod::mc
