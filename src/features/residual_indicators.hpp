// Moments and energies of the residual and difference signals: FM4, M6A, M8A, energy ratio and
// energy operator.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"

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

// FM4 of the averages of the single planets, largest value, normal = 3. They are assembled from
// windows around the planets' passages of the sensor: vibration separation of McFadden (1991) and
// Howard (1990), signals/windowing/vibration_separation.hpp; with FM4: D.
// G. Lewicki, K. E. LaBerge, R. T. Ehinger and J. Fetty, NASA/TM-2011-217127. The fault of one
// planet is not averaged with its sound companions as in fm4. NaN without passages of all teeth,
// and if the difference signals are rounding errors.
inline double separated_fm4(const SeparatedPlanets& planets) {
    double largest = kNan;
    for (std::size_t p = 0; p < planets.turn.size(); ++p) {
        if (!is_rounding(planets.difference[p], planets.turn[p])) {
            largest = std::fmax(largest, standardised_moment(planets.difference[p], 4));
        }
    }
    return largest;
}

// Energy ratio: RMS of the difference signal over RMS of the regular signal. Lebold et al. (2000).
inline double energy_ratio(const SensorTurn& sensor) {
    const auto sum_of_squares = [](std::span<const double> values) {
        return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    };
    return std::sqrt(sum_of_squares(sensor.difference) / sum_of_squares(sensor.regular));
}

// Energy operator: kurtosis of the Teager-Kaiser energy of the residual signal r,
//
//     E_i = r_i^2 - r_(i-1) r_(i+1),
//
// where r is periodic over the averaged turn. It is 9 for white Gaussian r. J. F. Kaiser,
// Proc. IEEE ICASSP (1990) 381-384; as a gear indicator: E. Bechhoefer and M. Kingsley, Proc.
// Annual Conf. of the PHM Society (2009). The energy of a tone is constant, A^2 sin^2(2 pi f / n),
// and thus rises with amplitude and frequency. A tooth fault changes both for a short time.
//
// NaN if the residual signal is rounding errors, or the deviation of its energy from the mean.
inline double energy_operator(const SensorTurn& sensor) {
    const std::span<const double> r = sensor.residual;
    const std::size_t n = r.size();
    std::vector<double> energy(n), square(n), deviation(n);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        square[i] = r[i] * r[i];
        energy[i] = square[i] - r[(i + n - 1) % n] * r[(i + 1) % n];
        sum += energy[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
        deviation[i] = energy[i] - sum / static_cast<double>(n);
    }
    return is_rounding(r, sensor.turn) || is_rounding(deviation, square)
               ? kNan
               : standardised_moment(energy, 4);
}

}  // namespace gearpod::features
