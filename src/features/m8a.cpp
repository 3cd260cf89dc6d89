// M8A: eighth moment of the difference signal over the fourth power of its variance, normal = 105.
// Martin (1989); Lebold et al. (2000); Samuel and Pines (2005).
#include "features/feature.hpp"
#include "features/standardised_moment.hpp"

namespace gearpod::features {

double m8a(const FeatureInput& input) {
    return standardised_moment(input.sensor.difference, 8);
}

double te_m8a(const FeatureInput& input) {
    return standardised_moment(input.te.difference, 8);
}

}  // namespace gearpod::features
