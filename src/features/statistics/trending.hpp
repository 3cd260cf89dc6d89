// Fourth moment of a signal over the square of its variance in healthy gearboxes. Unlike a
// kurtosis, it keeps rising when damage spreads and the variance grows.
#pragma once

#include <span>

namespace gearpod::features {

double trended_kurtosis(std::span<const double> values, double healthy_variance);

}  // namespace gearpod::features
