// Fourth moments of a signal over the square of its variance in healthy gearboxes. Unlike a
// kurtosis, they keep rising when damage spreads and the variance grows.
#pragma once

#include <numeric>
#include <span>

#include "features/signals.hpp"

namespace gearpod::features {

inline double trended_kurtosis(std::span<const double> values, double healthy_variance) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double fourth = 0.0;
    for (const double value : values) {
        const double square = (value - mean) * (value - mean);
        fourth += square * square;
    }
    return fourth / count / (healthy_variance * healthy_variance);
}

// NA4: fourth moment of the residual signal over the squared mean variance of the residual signals
// of M earlier records; Zakrajsek, Townsend and Decker, NASA TM-105950 (1993). Here the earlier
// records are those of M healthy gearboxes (mc/gearbox/healthy_reference.hpp). This is the NA4 of a
// gearbox that resembled them when its record began; a healthy one has about 3.
inline double na4(const SensorTurn& sensor, const HealthyRecords& healthy) {
    return trended_kurtosis(sensor.residual, healthy.residual_variance);
}

// NB4: the same as NA4 for the envelope of the signal around the first mesh harmonic. Zakrajsek,
// Handschuh and Decker, NASA TM-106467 (1994); the band: signals/spectra/mesh_separation.hpp.
inline double nb4(const SensorTurn& sensor, const HealthyRecords& healthy) {
    return trended_kurtosis(sensor.envelope, healthy.envelope_variance);
}

}  // namespace gearpod::features
