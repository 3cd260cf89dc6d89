// Peak of the kurtogram.
#pragma once

#include "features/signals.hpp"
#include "machine/no_value.hpp"
#include "signals/demodulation/kurtogram.hpp"

namespace gearpod::features {

// Largest kurtosis of the complex envelope of the sensor samples over the bands of the kurtogram
// (signals/demodulation/kurtogram.hpp). Antoni (2007).
//
// The levels end before the bands become narrower than a mesh order, so that an envelope still
// resolves single teeth. The value is 0 for stationary Gaussian noise, apart from the scatter of
// the largest of the bands: 2 / sqrt(C) for one band of C orders. NaN for a signal of rounding
// errors.
inline double kurtogram_peak(const SensorSamples& sensor, const SensorTurn& average) {
    const std::size_t per_mesh = average.turn.size() / static_cast<std::size_t>(average.mesh_order);
    const signals::Kurtogram kurtogram(sensor.samples, per_mesh / 2);
    return kurtogram.peak() == nullptr ? kNan : kurtogram.peak()->kurtosis;
}

}  // namespace gearpod::features
