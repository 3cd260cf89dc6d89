// Robust standard score of the worst tooth against the other teeth of the same planet:
//
//     z = (max - median) / (1.4826 MAD),
//
// median and median absolute deviation of the other teeth; 1.4826 makes MAD the standard deviation
// of a normal sample. Simulated teeth without noise are alike to the last bit and their MAD is
// zero, so it is not taken below 1e-6 of the median: far less than any sensor tells teeth apart by,
// and z stays finite (0 where all teeth agree).
#include <algorithm>
#include <cmath>

#include "features/feature.hpp"
#include "features/median.hpp"

namespace gearpod::features {

double window_z(const FeatureInput& input) {
    constexpr double kNormalScale = 1.4826;
    constexpr double kRelativeFloor = 1e-6;
    if (input.tooth_rms.size() < 2) {
        return median({});
    }
    std::vector<double> others(input.tooth_rms.begin(), input.tooth_rms.end());
    const auto worst = std::max_element(others.begin(), others.end());
    const double largest = *worst;
    others.erase(worst);
    const double middle = median(others);
    std::transform(others.begin(), others.end(), others.begin(),
                   [middle](double rms) { return std::abs(rms - middle); });
    const double spread = std::max(median(others), kRelativeFloor * middle);
    return (largest - middle) / (kNormalScale * spread);
}

}  // namespace gearpod::features
