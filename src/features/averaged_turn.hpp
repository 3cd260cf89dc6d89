// Averaged sensor signal without its mean, for features that filter it.
#pragma once

#include <numeric>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/rounding.hpp"

namespace gearpod::features {

// Empty if the signal without its mean is rounding errors.
inline std::vector<double> turn_about_mean(const SensorTurn& sensor) {
    const double sum = std::accumulate(sensor.turn.begin(), sensor.turn.end(), 0.0);
    std::vector<double> x(sensor.turn.begin(), sensor.turn.end());
    for (double& value : x) {
        value -= sum / static_cast<double>(x.size());
    }
    return is_rounding(x, sensor.turn) ? std::vector<double>() : x;
}

}  // namespace gearpod::features
