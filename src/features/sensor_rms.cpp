// Root mean square of the sensor signal over the span, a standard indicator of condition monitors.
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {

double sensor_rms(const FeatureInput& input) {
    return std::sqrt(input.sensor_mean_square);
}

}  // namespace gearpod::features
