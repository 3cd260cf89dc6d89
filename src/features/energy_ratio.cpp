// Energy ratio: RMS of the difference signal over RMS of the regular signal. Lebold et al. (2000).
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {
namespace {

double sum_of_squares(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value * value;
    }
    return sum;
}

}  // namespace

double energy_ratio(const FeatureInput& input) {
    return std::sqrt(sum_of_squares(input.sensor.difference) /
                     sum_of_squares(input.sensor.regular));
}

}  // namespace gearpod::features
