// Cyclic spectral coherence of the sensor samples at the order of the planet turn, averaged over
// the frequency bands (signals/demodulation/demodulation.hpp): Antoni (2007, 2009). A faulty
// planet tooth modulates the vibration once per planet turn, and a turn is many frames of a mesh
// period. NaN for less than three planet turns and for a zero signal.
#pragma once

#include <vector>

#include "features/signals.hpp"
#include "features/spectral_kurtosis.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"
#include "signals/demodulation/demodulation.hpp"

namespace gearpod::features {

inline double cyclic_coherence(const SensorSamples& sensor, const SensorTurn& average) {
    constexpr std::size_t kFewestTurns = 3;
    const std::size_t turn = average.turn.size();
    return sensor.samples.size() < kFewestTurns * turn
               ? kNan
               : signals::cyclic_coherence(sensor.samples, turn,
                                           turn / static_cast<std::size_t>(average.mesh_order));
}

// Lines of the planet turn in the squared-envelope spectrum of the sensor samples over the record,
// in the band of spectral_kurtosis.hpp. Antoni (2007); R. B. Randall and J. Antoni, Mech. Syst.
// Signal Process. 25 (2011) 485-520.
//
// A faulty planet tooth modulates the vibration once per planet turn. With E the magnitudes of the
// Fourier transform of the squared envelope, the feature is
//
//     sum over h of E(h) / sum over h of median of E near h,   h = 1 to H orders of the planet
//     turn,
//
// H = 5, or the largest order below Z_p / 2 if that is less. Orders near h are within half an order
// of it, without h itself; lines of the carrier turn are few of them. The feature is near 1 in
// stationary noise. NaN for less than three planet turns, for a signal of rounding errors, and if
// the medians are below 1e-12 of E(0), as in a record without noise.
inline double envelope_order(const SensorSamples& sensor, const SensorTurn& average) {
    constexpr std::size_t kFewestTurns = 3, kMostHarmonics = 5;
    constexpr double kRounding = 1e-12;
    const std::size_t turns = sensor.samples.size() / average.turn.size();
    const auto teeth = static_cast<std::size_t>(average.mesh_order);
    if (turns < kFewestTurns) {
        return kNan;
    }
    const signals::Kurtogram kurtogram = kurtogram_of(sensor, average);
    if (kurtogram.peak() == nullptr) {
        return kNan;
    }
    const std::vector<double> spectrum =
        signals::envelope_spectrum(kurtogram.squared_envelope(*kurtogram.peak()));
    double lines = 0.0, background = 0.0;
    for (std::size_t h = 1; h <= kMostHarmonics && 2 * h < teeth; ++h) {
        const std::size_t line = h * turns;
        std::vector<double> near;
        for (std::size_t d = 1; d <= turns / 2; ++d) {
            near.push_back(spectrum[line - d]);
            near.push_back(spectrum[line + d]);
        }
        lines += spectrum[line];
        background += median(std::move(near));
    }
    return background > kRounding * spectrum[0] ? lines / background : kNan;
}

}  // namespace gearpod::features
