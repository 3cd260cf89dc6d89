// Figure of merit zero: peak-to-peak over the sum of the amplitudes at the mesh order Z_p and its
// harmonics, up to te_harmonics of them and below the Nyquist order: Park et al. (2016), Table II.
#include <algorithm>
#include <limits>

#include "features/feature.hpp"

namespace gearpod::features {

double te_fm0(const FeatureInput& input) {
    const auto [low, high] = std::minmax_element(input.te_turn.begin(), input.te_turn.end());
    double harmonics = 0.0;
    for (int j = 1; j <= input.te_harmonics; ++j) {
        const std::size_t order = static_cast<std::size_t>(j) * input.planet_teeth;
        if (2 * order >= input.te_turn.size()) {
            break;
        }
        harmonics += input.te_amplitude[order];
    }
    // NaN if the encoder's sampling rate is too low for any mesh harmonic.
    return harmonics > 0.0 ? (*high - *low) / harmonics : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gearpod::features
