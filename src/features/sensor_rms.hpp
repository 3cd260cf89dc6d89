// Root mean square of the sensor signal over the span, a standard indicator of condition monitors.
#pragma once

#include <cmath>

#include "features/signals.hpp"

namespace gearpod::features {

inline double sensor_rms(const SensorPower& sensor) {
    return std::sqrt(sensor.mean_square);
}

}  // namespace gearpod::features
