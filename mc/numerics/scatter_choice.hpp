// Chooses steps and selective mass scaling for numerics.scatter_tolerance: the fewest steps per
// mesh period with which no feature changes by more than that share of its scatter.
#pragma once

#include "mc/numerics/numerics_choice.hpp"

namespace gearpod::mc {

// Integrates the first sixteen healthy gearboxes of the study, with the steps of the integrator's
// own rule and with fewer steps and more mass scaling. If the study gives both, they are the only
// candidate. Depends on the study only. Throws SceneError if the study gives one of them, or both
// and they do not keep the tolerance.
NumericsChoice choose_by_scatter(const Study& study);

}  // namespace gearpod::mc
