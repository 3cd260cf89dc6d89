#include "features/statistics/signal_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "machine/no_value.hpp"

namespace gearpod::features {

double median(std::vector<double> values) {
    if (values.empty()) {
        return kNan;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) {
        return *middle;
    }
    return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

double standardised_moment(std::span<const double> values, int power) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double second = 0.0;
    double high = 0.0;
    for (const double value : values) {
        const double square = (value - mean) * (value - mean);
        double product = square;
        for (int p = 2; p < power; p += 2) {
            product *= square;
        }
        second += square;
        high += product;
    }
    second /= count;
    double scale = second;
    for (int p = 2; p < power; p += 2) {
        scale *= second;
    }
    return high / count / scale;
}

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
