// First-order sidebands of the first mesh harmonic, orders Z_p - 1 and Z_p + 1 of the averaged
// sensor signal. The index is their mean amplitude. The level is their sum over the signal's RMS
// about its mean. Lebold et al. (2000).
#pragma once

#include <cmath>

#include "features/signals.hpp"

namespace gearpod::features {

inline double both_sidebands(const SensorTurn& sensor) {
    const auto mesh = static_cast<std::size_t>(sensor.mesh_order);
    return sensor.amplitude[mesh - 1] + sensor.amplitude[mesh + 1];
}

inline double sideband_index(const SensorTurn& sensor) {
    return 0.5 * both_sidebands(sensor);
}

inline double sideband_level(const SensorTurn& sensor) {
    // regular + difference is the turn without its mean.
    double squares = 0.0;
    for (std::size_t i = 0; i < sensor.regular.size(); ++i) {
        const double d = sensor.regular[i] + sensor.difference[i];
        squares += d * d;
    }
    return both_sidebands(sensor) / std::sqrt(squares / static_cast<double>(sensor.regular.size()));
}

}  // namespace gearpod::features
