// First-order sidebands of the first mesh harmonic, orders Z_p - 1 and Z_p + 1 of the averaged
// sensor signal. The index is their mean amplitude. The level is their sum over the signal's RMS
// about its mean. Lebold et al. (2000).
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {
namespace {

double both_sidebands(const FeatureInput& input) {
    const auto mesh = static_cast<std::size_t>(input.planet_teeth);
    return input.sensor.amplitude[mesh - 1] + input.sensor.amplitude[mesh + 1];
}

}  // namespace

double sideband_index(const FeatureInput& input) {
    return 0.5 * both_sidebands(input);
}

double sideband_level(const FeatureInput& input) {
    // regular + difference is the turn without its mean.
    double squares = 0.0;
    for (std::size_t i = 0; i < input.sensor.regular.size(); ++i) {
        const double d = input.sensor.regular[i] + input.sensor.difference[i];
        squares += d * d;
    }
    return both_sidebands(input) /
           std::sqrt(squares / static_cast<double>(input.sensor.regular.size()));
}

}  // namespace gearpod::features
