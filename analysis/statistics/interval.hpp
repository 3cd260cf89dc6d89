// Interval of an estimate, and the value that marks a missing estimate.
#pragma once

#include <limits>

namespace gearpod::analysis {

// Marks a quantity that could not be estimated.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Interval {
    double lower = 0.0;
    double upper = 1.0;
};

}  // namespace gearpod::analysis
