#include "features/statistics/trending.hpp"

namespace gearpod::features {

double trended_kurtosis(std::span<const double> values, double healthy_variance) {
    const auto count = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    const double mean = sum / count;
    double fourth = 0.0;
    for (const double value : values) {
        const double square = (value - mean) * (value - mean);
        fourth += square * square;
    }
    return fourth / count / (healthy_variance * healthy_variance);
}

}  // namespace gearpod::features
