// Root mean square of the averaged transmission error: Park et al. (2016), Table II.
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {

double te_rms(const FeatureInput& input) {
    double sum = 0.0;
    for (const double value : input.te_turn) {
        sum += value * value;
    }
    return std::sqrt(sum / static_cast<double>(input.te_turn.size()));
}

}  // namespace gearpod::features
