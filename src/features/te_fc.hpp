// Frequency centre: sum of f s(f) over sum of s(f), f > 0, in orders of the planet turn: Park et
// al. (2016), Table II. It decreases when a local fault adds sidebands at low orders.
#pragma once

#include "features/signals.hpp"

namespace gearpod::features {

inline double te_fc(const TeTurn& te) {
    double weighted = 0.0;
    double sum = 0.0;
    for (std::size_t order = 1; order < te.amplitude.size(); ++order) {
        weighted += static_cast<double>(order) * te.amplitude[order];
        sum += te.amplitude[order];
    }
    return weighted / sum;
}

}  // namespace gearpod::features
