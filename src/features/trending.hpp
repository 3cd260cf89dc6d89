// Fourth moment of a signal over the square of the variance that healthy gearboxes have in it:
// unlike a kurtosis it goes on rising when damage spreads and the variance grows with it.
#pragma once

#include <span>

namespace gearpod::features {

double trended_kurtosis(std::span<const double> values, double healthy_variance);

}  // namespace gearpod::features
