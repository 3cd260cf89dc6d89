// NB4: the same as NA4 for the envelope of the signal around the first mesh harmonic. Zakrajsek,
// Handschuh and Decker, NASA TM-106467 (1994); the band: signals/spectra/mesh_separation.hpp.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/trending.hpp"

namespace gearpod::features {

inline double nb4(const SensorTurn& sensor, const HealthyRecords& healthy) {
    return trended_kurtosis(sensor.envelope, healthy.envelope_variance);
}

}  // namespace gearpod::features
