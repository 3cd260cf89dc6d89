// M6A: sixth moment of the difference signal over the cube of its variance, normal = 15. Martin
// (1989); Lebold et al. (2000); Samuel and Pines (2005).
#include "features/feature.hpp"
#include "features/standardised_moment.hpp"

namespace gearpod::features {

double m6a(const FeatureInput& input) {
    return standardised_moment(input.sensor.difference, 6);
}

double te_m6a(const FeatureInput& input) {
    return standardised_moment(input.te.difference, 6);
}

}  // namespace gearpod::features
