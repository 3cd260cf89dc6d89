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
#pragma once

#include <limits>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/rounding.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

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
               ? std::numeric_limits<double>::quiet_NaN()
               : standardised_moment(energy, 4);
}

}  // namespace gearpod::features
