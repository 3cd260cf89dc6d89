// Hamming window: 8 % of the signal of the farthest planet remains. Liang (2016), Eq. 4.3.1.
#pragma once

#include <cmath>

namespace gearpod::signals {

inline double hamming(double x_rad) {
    return 0.54 - 0.46 * std::cos(x_rad);
}

}  // namespace gearpod::signals
