// Exact interval of a proportion: C. J. Clopper, E. S. Pearson, Biometrika 26 (1934), 404-413. Its
// coverage is never below the confidence, so it is wider than Wilson's.
#pragma once

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Two-sided interval: each tail at most (1 - confidence) / 2. `confidence` in (0, 1). NaN bounds if
// `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval clopper_pearson_interval(long detected, long tested, double confidence);

}  // namespace gearpod::analysis
