// Probabilities of several tests, adjusted so that the chance of any false rejection stays at the
// level: S. Holm, Scand. J. Stat. 6 (1979), 65-70.
#pragma once

#include <vector>

namespace gearpod::analysis {

// In the order given. NaN entries are no tests and stay NaN.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace gearpod::analysis
