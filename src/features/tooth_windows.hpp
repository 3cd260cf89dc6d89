// The worst tooth of a gear against its other teeth. A ratio to the median tooth needs no healthy
// reference and is independent of the signal's scale.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"

namespace gearpod::features {

// Largest tooth RMS over the median one: Liang (2016), Fig. 5.8, expressed as a ratio. It applies
// to teeth of the planets, the sun and the ring.
template <gears::Member kGear>
inline double window_ratio(const ToothRms<kGear>& teeth) {
    return worst_to_median(teeth.rms);
}

// Robust standard score of the worst tooth's RMS against the other teeth of the same gear
// (signal_statistics.hpp).
template <gears::Member kGear>
inline double window_z(const ToothRms<kGear>& teeth) {
    return worst_score(teeth.rms);
}

// Largest tooth kurtosis over the median one. Liang (2016), section 5.4, lists kurtosis among the
// possible substitutes for the RMS.
template <gears::Member kGear>
inline double window_kurtosis(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.kurtosis);
}

// Largest tooth crest factor over the median one; mentioned in Liang (2016), section 5.4, citing
// Chen and Shao.
template <gears::Member kGear>
inline double window_crest(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.crest);
}

// Largest tooth M8A over the median one; mentioned in Liang (2016), section 5.4, citing Lewicki et
// al.
template <gears::Member kGear>
inline double window_m8a(const ToothMoments<kGear>& teeth) {
    return worst_to_median(teeth.m8a);
}

// window_ratio of the sensor samples after cepstral pre-whitening
// (signals/prediction/prewhitening.hpp): Borghesani et al. (2013), with the tooth windows of
// Liang (2016). The mesh lines, which hide weak impulses of a tooth, then count no more than any
// other order. NaN for a zero signal.
inline double whitened_window_ratio(const WhitenedToothRms& teeth) {
    return worst_to_median(teeth.rms);
}

}  // namespace gearpod::features
