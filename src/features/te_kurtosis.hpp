// Kurtosis of the averaged transmission error about its mean, 3 for a normal distribution:
// Park et al. (2016), Table II.
#pragma once

#include "features/signals.hpp"

namespace gearpod::features {

inline double te_kurtosis(const TeTurn& te) {
    const auto count = static_cast<double>(te.turn.size());
    double sum = 0.0;
    for (const double value : te.turn) {
        sum += value;
    }
    const double mean = sum / count;
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
