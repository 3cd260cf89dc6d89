// Robust standard score of the worst tooth's RMS against the other teeth of the same gear
// (worst_tooth.hpp).
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

template <Gear kGear>
inline double window_z(const ToothRms<kGear>& teeth) {
    return worst_score(teeth.rms);
}

}  // namespace gearpod::features
