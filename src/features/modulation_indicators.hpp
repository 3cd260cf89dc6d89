// First-order sidebands of the first mesh harmonic, orders Z_p - 1 and Z_p + 1 of the averaged
// sensor signal. The index is their mean amplitude. The level is their sum over the signal's RMS
// about its mean. Lebold et al. (2000).
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "features/signals.hpp"
#include "machine/no_value.hpp"
#include "signals/demodulation/demodulation.hpp"

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

// Amplitude and phase modulation of the strongest mesh harmonic of the averaged sensor signal, from
// its demodulated signal b(t) (signals/demodulation/demodulation.hpp): McFadden (1986).
//
//     amplitude_modulation  largest magnitude of |b| / mean(|b|) - 1
//     phase_modulation      peak-to-peak of the unwrapped phase of b, rad
//
// A cracked tooth delays the mesh for one tooth, which shows in both. NaN if there are no mesh
// lines apart from rounding errors.
inline double amplitude_modulation(const SensorTurn& sensor) {
    const auto modulation =
        signals::mesh_modulation(sensor.turn, sensor.amplitude, sensor.mesh_order);
    double sum = 0.0;
    for (const auto& value : modulation) {
        sum += std::abs(value);
    }
    const double mean = sum / static_cast<double>(modulation.size());
    double largest = modulation.empty() ? kNan : 0.0;
    for (const auto& value : modulation) {
        largest = std::max(largest, std::abs(std::abs(value) / mean - 1.0));
    }
    return largest;
}

inline double phase_modulation(const SensorTurn& sensor) {
    const auto modulation =
        signals::mesh_modulation(sensor.turn, sensor.amplitude, sensor.mesh_order);
    if (modulation.empty()) {
        return kNan;
    }
    double phase = 0.0, low = 0.0, high = 0.0;
    for (std::size_t i = 1; i < modulation.size(); ++i) {
        phase += std::arg(modulation[i] * std::conj(modulation[i - 1]));
        low = std::min(low, phase);
        high = std::max(high, phase);
    }
    return high - low;
}

}  // namespace gearpod::features
