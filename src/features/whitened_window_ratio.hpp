// Largest tooth RMS over the median one (window_ratio.hpp) of the sensor samples after cepstral
// pre-whitening (signals/prediction/prewhitening.hpp): Borghesani et al. (2013), with the tooth
// windows of Liang (2016). The mesh lines, which hide weak impulses of a tooth, then count no more
// than any other order. NaN for a zero signal.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/worst_tooth.hpp"

namespace gearpod::features {

inline double whitened_window_ratio(const WhitenedToothRms& teeth) {
    return worst_to_median(teeth.rms);
}

}  // namespace gearpod::features
