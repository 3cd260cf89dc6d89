// Largest tooth kurtosis over the median one. Liang (2016), section 5.4, lists kurtosis among the
// possible substitutes for the RMS.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

template <Gear kGear>
inline double window_kurtosis(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.kurtosis);
}

}  // namespace gearpod::features
