// Median of a small sample; NaN for an empty one.
#pragma once

#include <vector>

namespace gearpod::features {

double median(std::vector<double> values);

}  // namespace gearpod::features
