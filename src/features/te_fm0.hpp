// Figure of merit zero: peak-to-peak over the sum of the amplitudes at the mesh order Z_p and its
// harmonics, up to te_harmonics of them and below the Nyquist order: Park et al. (2016), Table II.
#pragma once

#include <algorithm>
#include <limits>

#include "features/signals.hpp"

namespace gearpod::features {

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
    return harmonics > 0.0 ? (*high - *low) / harmonics : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gearpod::features
