// Adjustment of the p-values of several tests that keeps the probability of any false rejection at
// the level: S. Holm, Scand. J. Stat. 6 (1979), 65-70.
#pragma once

#include <vector>

namespace gearpod::analysis {

// Adjusted p-values in the given order. NaN entries count as no test and stay NaN.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace gearpod::analysis
