// Figure of merit four: kurtosis of the difference signal, normal = 3. Stewart (1977); Lebold et
// al. (2000); Samuel and Pines (2005).
#include "features/feature.hpp"
#include "features/standardised_moment.hpp"

namespace gearpod::features {

double fm4(const FeatureInput& input) {
    return standardised_moment(input.sensor.difference, 4);
}

double te_fm4(const FeatureInput& input) {
    return standardised_moment(input.te.difference, 4);
}

}  // namespace gearpod::features
