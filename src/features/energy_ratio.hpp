// Energy ratio: RMS of the difference signal over RMS of the regular signal. Lebold et al. (2000).
#pragma once

#include <cmath>

#include "features/signals.hpp"

namespace gearpod::features {

inline double energy_ratio(const SensorTurn& sensor) {
    const auto sum_of_squares = [](std::span<const double> values) {
        double sum = 0.0;
        for (const double value : values) {
            sum += value * value;
        }
        return sum;
    };
    return std::sqrt(sum_of_squares(sensor.difference) / sum_of_squares(sensor.regular));
}

}  // namespace gearpod::features
