// Chooses steps and selective mass scaling for numerics.scatter_tolerance: the fewest steps per
// mesh period with which no feature changes by more than that share of its scatter.
#pragma once

#include <optional>

#include "mc/numerics/numerics_choice.hpp"

namespace gearpod::mc {

// Numerics with at most this many steps per mesh period, apart from those at contact transitions,
// and the highest limit of the mass scaling found that allows them; empty if none does. `own`:
// central differences without mass scaling. Throws SceneError if it cannot be used.
std::optional<Numerics> scaled_numerics(const Scene& own, int steps);

// Integrates the first sixteen healthy gearboxes of the study, with the steps of the integrator's
// own rule and with fewer steps and more mass scaling. If the study gives both, they are the only
// candidate. Depends on the study only. Throws SceneError if the study gives one of them, or both
// and they do not keep the tolerance.
NumericsChoice choose_by_scatter(const Study& study);

}  // namespace gearpod::mc
