// Largest tooth crest factor over the median one; mentioned in Liang (2016), section 5.4, citing
// Chen and Shao.
#include "features/feature.hpp"
#include "features/worst_tooth.hpp"

namespace gearpod::features {

double window_crest(const FeatureInput& input) {
    return worst_to_median(input.planet.crest);
}

double sun_window_crest(const FeatureInput& input) {
    return worst_to_median(input.sun.crest);
}

double ring_window_crest(const FeatureInput& input) {
    return worst_to_median(input.ring.crest);
}

}  // namespace gearpod::features
