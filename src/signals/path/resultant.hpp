// Sensor value from the planets' accelerations and path weights. The folded signal and the time
// signal share it, so that both give the same bits.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::signals {

// Sensor value y of lane l from accel[channel][lane] and weight[n][lane].
template <int N, int W>
GEARPOD_INLINE double resultant(const double* __restrict accel, const double* __restrict weight,
                                double sine, double cosine, int l) {
    double along_x = 0.0;
    double along_y = 0.0;
#pragma GCC unroll 8
    for (int n = 0; n < N; ++n) {
        along_x = std::fma(weight[n * W + l], accel[2 * n * W + l], along_x);
        along_y = std::fma(weight[n * W + l], accel[(2 * n + 1) * W + l], along_y);
    }
    return std::fma(sine, along_x, cosine * along_y);
}

}  // namespace gearpod::signals
