// NSDS, normalized summation of the positive amplitudes of the difference spectrum, after Lei et
// al., Meas. Sci. Technol. 23 (2012) 055605: excess of the spectrum over that of healthy gearboxes,
// relative to the latter,
//
//     NSDS = sum over f > 0 of max(0, s(f) - s_h(f)) / sum over f > 0 of s_h(f),
//
// where s are the amplitudes of the averaged turn, and s_h their mean over the healthy records.
#include <algorithm>

#include "features/feature.hpp"

namespace gearpod::features {

double nsds(const FeatureInput& input) {
    double above = 0.0, healthy = 0.0;
    for (std::size_t k = 1; k < input.healthy.amplitude.size(); ++k) {
        above += std::max(0.0, input.sensor.amplitude[k] - input.healthy.amplitude[k]);
        healthy += input.healthy.amplitude[k];
    }
    return above / healthy;
}

}  // namespace gearpod::features
