// Kurtosis of the averaged transmission error about its mean, 3 for a normal distribution:
// Park et al. (2016), Table II.
#pragma once

#include <numeric>

#include "features/signals.hpp"

namespace gearpod::features {

inline double te_kurtosis(const TeTurn& te) {
    const auto count = static_cast<double>(te.turn.size());
    const double mean = std::accumulate(te.turn.begin(), te.turn.end(), 0.0) / count;
    double second = 0.0;
    double fourth = 0.0;
    for (const double value : te.turn) {
        const double square = (value - mean) * (value - mean);
        second += square;
        fourth += square * square;
    }
    return fourth * count / (second * second);
}

}  // namespace gearpod::features
