// Liang (2016), Eq. 4.3.1: 8 % of the farthest planet is left.
#pragma once

#include <cmath>

namespace gearpod::signals {

inline double hamming(double x_rad) {
    return 0.54 - 0.46 * std::cos(x_rad);
}

}  // namespace gearpod::signals
