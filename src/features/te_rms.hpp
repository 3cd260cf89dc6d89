// Root mean square of the averaged transmission error: Park et al. (2016), Table II.
#pragma once

#include <cmath>
#include <numeric>

#include "features/signals.hpp"

namespace gearpod::features {

inline double te_rms(const TeTurn& te) {
    const double sum = std::inner_product(te.turn.begin(), te.turn.end(), te.turn.begin(), 0.0);
    return std::sqrt(sum / static_cast<double>(te.turn.size()));
}

}  // namespace gearpod::features
