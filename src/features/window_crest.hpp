// Largest tooth crest factor over the median one; mentioned in Liang (2016), section 5.4, citing
// Chen and Shao.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

template <Gear kGear>
inline double window_crest(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.crest);
}

}  // namespace gearpod::features
