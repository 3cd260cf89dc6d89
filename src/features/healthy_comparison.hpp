// Features that compare a record with healthy ones: NA4, and the correlation with the baseline
// record.
#pragma once

#include <cmath>
#include <numeric>
#include <span>

#include "features/signals.hpp"

namespace gearpod::features {

// Fourth moments of a signal over the square of its variance in healthy gearboxes. Unlike a
// kurtosis, they keep rising when damage spreads and the variance grows.
inline double trended_kurtosis(std::span<const double> values, double healthy_variance) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double fourth = 0.0;
    for (const double value : values) {
        const double square = (value - mean) * (value - mean);
        fourth += square * square;
    }
    return fourth / count / (healthy_variance * healthy_variance);
}

// NA4: fourth moment of the residual signal over the squared mean variance of the residual signals
// of M earlier records; Zakrajsek, Townsend and Decker, NASA TM-105950 (1993). Here the earlier
// records are those of M healthy gearboxes (mc/ensemble/gearbox/realization_features.hpp). This is
// the NA4 of a gearbox that resembled them when its record began; a healthy one has about 3.
inline double na4(const SensorTurn& sensor, const HealthyRecords& healthy) {
    return trended_kurtosis(sensor.residual, healthy.residual_variance);
}

// Correlation coefficient of the averaged turns of a record and of its baseline. It falls as the
// signal changes its shape, and does not depend on the level of either. Pearson's coefficient; used
// for the similarity of a gear's averages before and after damage by W. Wang and A. K. Wong, J.
// Vib. Acoust. 124 (2002), 172-179, who predict a healthy record and judge the remainder.
//
// The baseline is the record less the change, because both are averaged sample by sample.
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
