// NSDS, normalized summation of the positive amplitudes of the difference spectrum, after Lei et
// al., Meas. Sci. Technol. 23 (2012) 055605: excess of the spectrum over that of healthy gearboxes,
// relative to the latter,
//
//     NSDS = sum over f > 0 of max(0, s(f) - s_h(f)) / sum over f > 0 of s_h(f),
//
// where s are the amplitudes of the averaged turn, and s_h their mean over the healthy records.
#pragma once

#include <algorithm>

#include "features/signals.hpp"

namespace gearpod::features {

inline double nsds(const SensorTurn& sensor, const HealthyRecords& healthy) {
    double above = 0.0, sum = 0.0;
    for (std::size_t k = 1; k < healthy.amplitude.size(); ++k) {
        above += std::max(0.0, sensor.amplitude[k] - healthy.amplitude[k]);
        sum += healthy.amplitude[k];
    }
    return above / sum;
}

}  // namespace gearpod::features
