#include "features/statistics/worst_tooth.hpp"

#include <algorithm>
#include <cmath>

#include "features/statistics/median.hpp"

namespace gearpod::features {

double worst_to_median(std::span<const double> teeth) {
    if (teeth.empty()) {
        return median({});
    }
    const double middle = median({teeth.begin(), teeth.end()});
    return *std::max_element(teeth.begin(), teeth.end()) / middle;
}

double worst_score(std::span<const double> teeth) {
    constexpr double kNormalScale = 1.4826;
    constexpr double kRelativeFloor = 1e-6;
    if (teeth.size() < 2) {
        return median({});
    }
    std::vector<double> others(teeth.begin(), teeth.end());
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
