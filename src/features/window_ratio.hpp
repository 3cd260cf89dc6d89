// Largest tooth RMS over the median one: Liang (2016), Fig. 5.8, expressed as a ratio, so that it
// needs no healthy reference and is independent of the signal's scale. It applies to teeth of the
// planets, the sun and the ring.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

template <Gear kGear>
inline double window_ratio(const ToothRms<kGear>& teeth) {
    return worst_to_median(teeth.rms);
}

}  // namespace gearpod::features
