// Features of the averaged transmission error.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/signals.hpp"
#include "machine/no_value.hpp"

namespace gearpod::features {

// Root mean square of the averaged transmission error: Park et al. (2016), Table II.
inline double te_rms(const TeTurn& te) {
    const double sum = std::inner_product(te.turn.begin(), te.turn.end(), te.turn.begin(), 0.0);
    return std::sqrt(sum / static_cast<double>(te.turn.size()));
}

// Kurtosis of the averaged transmission error about its mean, 3 for a normal distribution:
// Park et al. (2016), Table II.
inline double te_kurtosis(const TeTurn& te) {
    const auto count = static_cast<double>(te.turn.size());
    const double mean = std::accumulate(te.turn.begin(), te.turn.end(), 0.0) / count;
    double second = 0.0;
    double fourth = 0.0;
    for (const double value : te.turn) {
        const double square = (value - mean) * (value - mean);
        second += square;
        fourth += square * square;
    }
    return fourth * count / (second * second);
}

// Figure of merit zero: peak-to-peak over the sum of the amplitudes at the mesh order Z_p and its
// harmonics, up to te_harmonics of them and below the Nyquist order: Park et al. (2016), Table II.
inline double te_fm0(const TeTurn& te) {
    const auto [low, high] = std::minmax_element(te.turn.begin(), te.turn.end());
    double harmonics = 0.0;
    for (int j = 1; j <= te.harmonics; ++j) {
        const std::size_t order = static_cast<std::size_t>(j) * te.mesh_order;
        if (2 * order >= te.turn.size()) {
            break;
        }
        harmonics += te.amplitude[order];
    }
    // NaN if the encoder's sampling rate is too low for any mesh harmonic.
    return harmonics > 0.0 ? (*high - *low) / harmonics : kNan;
}

// Frequency centre: sum of f s(f) over sum of s(f), f > 0, in orders of the planet turn: Park et
// al. (2016), Table II. It decreases when a local fault adds sidebands at low orders.
inline double te_fc(const TeTurn& te) {
    double weighted = 0.0;
    double sum = 0.0;
    for (std::size_t order = 1; order < te.amplitude.size(); ++order) {
        weighted += static_cast<double>(order) * te.amplitude[order];
        sum += te.amplitude[order];
    }
    return weighted / sum;
}

}  // namespace gearpod::features
