// Standardized moment n^(p/2 - 1) sum (x - mean)^p / (sum (x - mean)^2)^(p/2) for even p; the
// kurtosis for p = 4.
#pragma once

#include <span>

namespace gearpod::features {

double standardised_moment(std::span<const double> values, int power);

}  // namespace gearpod::features
