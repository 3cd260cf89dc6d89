// Largest tooth RMS over the median one: Liang (2016), Fig. 5.8, read as a ratio, so that neither
// a healthy reference nor the absolute scale of the signal matters. For teeth of the sun and the
// ring as for the planets'.
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
