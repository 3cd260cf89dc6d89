// Kurtosis of the averaged transmission error about its mean, 3 for a normal distribution:
// Park et al. (2016), Table II.
#include "features/feature.hpp"

namespace gearpod::features {

double te_kurtosis(const FeatureInput& input) {
    const auto count = static_cast<double>(input.te_turn.size());
    double sum = 0.0;
    for (const double value : input.te_turn) {
        sum += value;
    }
    const double mean = sum / count;
    double second = 0.0;
    double fourth = 0.0;
    for (const double value : input.te_turn) {
        const double square = (value - mean) * (value - mean);
        second += square;
        fourth += square * square;
    }
    return fourth * count / (second * second);
}

}  // namespace gearpod::features
