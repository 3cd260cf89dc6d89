// Interval of a proportion: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209-212. Its coverage
// stays close to nominal for small samples and for rates near 0 and 1, which are usual for
// detection rates.
#pragma once

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Two-sided interval without continuity correction. `confidence` in (0, 1), e.g. 0.95. NaN bounds
// if `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval wilson_interval(long detected, long tested, double confidence);

}  // namespace gearpod::analysis
