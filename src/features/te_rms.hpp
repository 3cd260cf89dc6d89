// Root mean square of the averaged transmission error: Park et al. (2016), Table II.
#pragma once

#include <cmath>

#include "features/signals.hpp"

namespace gearpod::features {

inline double te_rms(const TeTurn& te) {
    double sum = 0.0;
    for (const double value : te.turn) {
        sum += value * value;
    }
    return std::sqrt(sum / static_cast<double>(te.turn.size()));
}

}  // namespace gearpod::features
