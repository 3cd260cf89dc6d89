// Natural frequencies of the gearbox of a study.
#pragma once

#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Natural frequencies, Hz, ascending, one per degree of freedom: undamped, at rest, at the mean
// mesh stiffness. The study may lack tooth numbers if its mesh stiffness is constant. Throws
// SceneError (mc/scene/scene_error.hpp) if masses or inertias are missing.
std::vector<double> natural_frequencies_Hz(const Study& study);

}  // namespace gearpod::mc
