// Root mean square of the sensor signal over the span, the indicator that every monitor has.
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {

double sensor_rms(const FeatureInput& input) {
    return std::sqrt(input.sensor_mean_square);
}

}  // namespace gearpod::features
