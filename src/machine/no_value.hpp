// Number that stands for "no value", for example of a feature that divides by zero.
#pragma once

#include <limits>

namespace gearpod {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace gearpod
