// Largest tooth M8A over the median one; mentioned in Liang (2016), section 5.4, citing Lewicki et
// al.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

template <Gear kGear>
inline double window_m8a(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.m8a);
}

}  // namespace gearpod::features
