// Energy ratio: RMS of the difference signal over RMS of the regular signal. Lebold et al. (2000).
#pragma once

#include <cmath>
#include <numeric>

#include "features/signals.hpp"

namespace gearpod::features {

inline double energy_ratio(const SensorTurn& sensor) {
    const auto sum_of_squares = [](std::span<const double> values) {
        return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    };
    return std::sqrt(sum_of_squares(sensor.difference) / sum_of_squares(sensor.regular));
}

}  // namespace gearpod::features
