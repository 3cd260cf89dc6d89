// Hann window: nothing of the signal of the farthest planet remains. Liang (2016), section 4.3,
// case 3 of Fig. 4.10.
#pragma once

#include <cmath>

namespace gearpod::signals {

inline double hann(double x_rad) {
    return 0.5 - 0.5 * std::cos(x_rad);
}

}  // namespace gearpod::signals
