// Correlation coefficient of the averaged turns of a record and of its baseline. It falls as the
// signal changes its shape, and does not depend on the level of either. Pearson's coefficient; used
// for the similarity of a gear's averages before and after damage by W. Wang and A. K. Wong, J.
// Vib. Acoust. 124 (2002), 172-179, who predict a healthy record and judge the remainder.
//
// The baseline is the record less the change, because both are averaged sample by sample.
#pragma once

#include <cmath>

#include "features/signals.hpp"

namespace gearpod::features {

inline double baseline_correlation(const SensorTurn& record, const SensorTurn& change) {
    const std::span<const double> now = record.turn, changed = change.turn;
    const auto count = static_cast<double>(now.size());
    double now_sum = 0.0, before_sum = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now_sum += now[i];
        before_sum += now[i] - changed[i];
    }
    double both = 0.0, now_squares = 0.0, before_squares = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double a = now[i] - now_sum / count;
        const double b = now[i] - changed[i] - before_sum / count;
        both += a * b;
        now_squares += a * a;
        before_squares += b * b;
    }
    return both / std::sqrt(now_squares * before_squares);
}

}  // namespace gearpod::features
