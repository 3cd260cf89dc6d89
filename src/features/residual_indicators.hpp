// Moments and energies of the difference signal: FM4, M6A, M8A and energy ratio.
#pragma once

#include <cmath>
#include <numeric>
#include <span>

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"

namespace gearpod::features {

// Standardised moments of the difference signal. Lebold et al. (2000); Samuel and Pines (2005).

// Figure of merit four: kurtosis of the difference signal, normal = 3. Stewart (1977).
inline double fm4(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 4);
}

inline double te_fm4(const TeParts& te) {
    return standardised_moment(te.difference, 4);
}

// M6A: sixth moment of the difference signal over the cube of its variance, normal = 15. Martin
// (1989).
inline double m6a(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 6);
}

inline double te_m6a(const TeParts& te) {
    return standardised_moment(te.difference, 6);
}

// M8A: eighth moment of the difference signal over the fourth power of its variance, normal = 105.
// Martin (1989).
inline double m8a(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 8);
}

inline double te_m8a(const TeParts& te) {
    return standardised_moment(te.difference, 8);
}

// Energy ratio: RMS of the difference signal over RMS of the regular signal. Lebold et al. (2000).
inline double energy_ratio(const SensorTurn& sensor) {
    const auto sum_of_squares = [](std::span<const double> values) {
        return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    };
    return std::sqrt(sum_of_squares(sensor.difference) / sum_of_squares(sensor.regular));
}

}  // namespace gearpod::features
