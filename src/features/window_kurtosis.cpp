// Largest tooth kurtosis over the median one. Liang (2016), section 5.4, lists kurtosis among the
// possible substitutes for the RMS.
#include "features/feature.hpp"
#include "features/worst_tooth.hpp"

namespace gearpod::features {

double window_kurtosis(const FeatureInput& input) {
    return worst_to_median(input.planet.kurtosis);
}

double sun_window_kurtosis(const FeatureInput& input) {
    return worst_to_median(input.sun.kurtosis);
}

double ring_window_kurtosis(const FeatureInput& input) {
    return worst_to_median(input.ring.kurtosis);
}

}  // namespace gearpod::features
