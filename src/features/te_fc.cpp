// Frequency centre: sum of f s(f) over sum of s(f), f > 0, in orders of the planet turn: Park et
// al. (2016), Table II. It decreases when a local fault adds sidebands at low orders.
#include "features/feature.hpp"

namespace gearpod::features {

double te_fc(const FeatureInput& input) {
    double weighted = 0.0;
    double sum = 0.0;
    for (std::size_t order = 1; order < input.te_amplitude.size(); ++order) {
        weighted += static_cast<double>(order) * input.te_amplitude[order];
        sum += input.te_amplitude[order];
    }
    return weighted / sum;
}

}  // namespace gearpod::features
