// Kurtosis of the averaged sensor signal about its mean, normal = 3; of the change signal, it rises
// when the change concentrates in few teeth. D. Dyer and R. M. Stewart, J. Mech. Des. 100 (1978),
// 229-235.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

inline double turn_kurtosis(const SensorTurn& sensor) {
    return standardised_moment(sensor.turn, 4);
}

}  // namespace gearpod::features
