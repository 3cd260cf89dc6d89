// Parts of a gearbox without damping.
#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Names the vibrating parts whose damping is 0 in every gearbox, for example "bearings of sun and
// ring, support of the ring". Empty if every part has damping, or in quasi-static studies.
std::string undamped(const Study& study);

}  // namespace gearpod::mc
