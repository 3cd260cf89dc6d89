// Largest tooth M8A over the median one; mentioned in Liang (2016), section 5.4, citing Lewicki et
// al.
#include "features/feature.hpp"
#include "features/worst_tooth.hpp"

namespace gearpod::features {

double window_m8a(const FeatureInput& input) {
    return worst_to_median(input.planet.m8a);
}

double sun_window_m8a(const FeatureInput& input) {
    return worst_to_median(input.sun.m8a);
}

double ring_window_m8a(const FeatureInput& input) {
    return worst_to_median(input.ring.m8a);
}

}  // namespace gearpod::features
