// Confidence intervals of a proportion.
#pragma once

#include "machine/no_value.hpp"

namespace gearpod::analysis {

struct Interval {
    double lower = 0.0;
    double upper = 1.0;
};

// Interval of a proportion: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209-212. Its coverage
// stays close to nominal for small samples and for rates near 0 and 1, which are usual for
// detection rates.

// Two-sided interval without continuity correction. `confidence` in (0, 1), e.g. 0.95. NaN bounds
// if `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval wilson_interval(long detected, long tested, double confidence);

// Exact interval of a proportion: C. J. Clopper, E. S. Pearson, Biometrika 26 (1934), 404-413. Its
// coverage is never below the confidence, so it is wider than Wilson's.

// Two-sided interval: each tail at most (1 - confidence) / 2. `confidence` in (0, 1). NaN bounds if
// `tested` is 0; throws std::invalid_argument unless 0 <= detected <= tested.
Interval clopper_pearson_interval(long detected, long tested, double confidence);

}  // namespace gearpod::analysis
