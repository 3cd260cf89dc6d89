// Largest tooth RMS over the median one: Liang (2016), Fig. 5.8, expressed as a ratio, so that it
// needs no healthy reference and is independent of the signal's scale. It applies to teeth of the
// planets, the sun and the ring.
#include "features/feature.hpp"
#include "features/worst_tooth.hpp"

namespace gearpod::features {

double window_ratio(const FeatureInput& input) {
    return worst_to_median(input.tooth_rms);
}

double sun_window_ratio(const FeatureInput& input) {
    return worst_to_median(input.sun.rms);
}

double ring_window_ratio(const FeatureInput& input) {
    return worst_to_median(input.ring.rms);
}

}  // namespace gearpod::features
