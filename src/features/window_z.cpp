// Robust standard score of the worst tooth's RMS against the other teeth of the same gear
// (worst_tooth.hpp).
#include "features/feature.hpp"
#include "features/worst_tooth.hpp"

namespace gearpod::features {

double window_z(const FeatureInput& input) {
    return worst_score(input.tooth_rms);
}

double sun_window_z(const FeatureInput& input) {
    return worst_score(input.sun.rms);
}

double ring_window_z(const FeatureInput& input) {
    return worst_score(input.ring.rms);
}

}  // namespace gearpod::features
