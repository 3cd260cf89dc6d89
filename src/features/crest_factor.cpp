// Crest factor of the averaged sensor signal: largest magnitude about the mean over the RMS about
// it. Samuel and Pines (2005).
#include <algorithm>
#include <cmath>

#include "features/feature.hpp"

namespace gearpod::features {

double crest_factor(const FeatureInput& input) {
    const std::span<const double> turn = input.sensor.turn;
    const auto count = static_cast<double>(turn.size());
    double sum = 0.0;
    for (const double value : turn) {
        sum += value;
    }
    double squares = 0.0, peak = 0.0;
    for (const double value : turn) {
        const double d = value - sum / count;
        squares += d * d;
        peak = std::max(peak, std::abs(d));
    }
    return peak / std::sqrt(squares / count);
}

}  // namespace gearpod::features
