// Cyclic spectral coherence of the sensor samples at the order of the planet turn, averaged over
// the frequency bands (signals/demodulation/cyclic_coherence.hpp): Antoni (2007, 2009). A faulty
// planet tooth modulates the vibration once per planet turn, and a turn is many frames of a mesh
// period. NaN for less than three planet turns and for a zero signal.
#pragma once

#include <limits>

#include "features/signals.hpp"
#include "signals/demodulation/cyclic_coherence.hpp"

namespace gearpod::features {

inline double cyclic_coherence(const SensorSamples& sensor, const SensorTurn& average) {
    constexpr std::size_t kFewestTurns = 3;
    const std::size_t turn = average.turn.size();
    return sensor.samples.size() < kFewestTurns * turn
               ? std::numeric_limits<double>::quiet_NaN()
               : signals::cyclic_coherence(sensor.samples, turn,
                                           turn / static_cast<std::size_t>(average.mesh_order));
}

}  // namespace gearpod::features
