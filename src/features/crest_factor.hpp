// Crest factor of the averaged sensor signal: largest magnitude about the mean over the RMS about
// it. Samuel and Pines (2005).
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/signals.hpp"

namespace gearpod::features {

inline double crest_factor(const SensorTurn& sensor) {
    const std::span<const double> turn = sensor.turn;
    const auto count = static_cast<double>(turn.size());
    const double sum = std::accumulate(turn.begin(), turn.end(), 0.0);
    double squares = 0.0, peak = 0.0;
    for (const double value : turn) {
        const double d = value - sum / count;
        squares += d * d;
        peak = std::max(peak, std::abs(d));
    }
    return peak / std::sqrt(squares / count);
}

}  // namespace gearpod::features
