// Largest tooth RMS over the median one: Liang (2016), Fig. 5.8, read as a ratio, so that neither
// a healthy reference nor the absolute scale of the signal matters.
#include <algorithm>

#include "features/feature.hpp"
#include "features/median.hpp"

namespace gearpod::features {

double window_ratio(const FeatureInput& input) {
    if (input.tooth_rms.empty()) {
        return median({});
    }
    const double middle = median({input.tooth_rms.begin(), input.tooth_rms.end()});
    return *std::max_element(input.tooth_rms.begin(), input.tooth_rms.end()) / middle;
}

}  // namespace gearpod::features
