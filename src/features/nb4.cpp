// NB4: the same as NA4 for the envelope of the signal around the first mesh harmonic. Zakrajsek,
// Handschuh and Decker, NASA TM-106467 (1994); the band: signals/spectra/mesh_separation.hpp.
#include "features/feature.hpp"
#include "features/trending.hpp"

namespace gearpod::features {

double nb4(const FeatureInput& input) {
    return trended_kurtosis(input.sensor.envelope, input.healthy.envelope_variance);
}

}  // namespace gearpod::features
