// Statistics of the sensor signal and of its average over a turn.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"

namespace gearpod::features {

// Root mean square of the sensor signal over the span, a standard indicator of condition monitors.
inline double sensor_rms(const SensorPower& sensor) {
    return std::sqrt(sensor.mean_square);
}

// FRMS, root mean square of the filtered signal, after Lei, Kong, Lin and Zuo, Meas. Sci. Technol.
// 23 (2012) 055605: the signal of a planetary gearbox without its regular lines. These are the mesh
// harmonics and their sidebands due to the carrier's rotation. All are whole multiples of the
// carrier frequency, so the filter subtracts the average over carrier turns. Lines of sun and
// planet teeth have other orders; those of a tooth of a fixed ring coincide with the regular ones.
inline double frms(const FilteredSensor& sensor) {
    return sensor.rms;
}

// Crest factor of the averaged sensor signal: largest magnitude about the mean over the RMS about
// it. Samuel and Pines (2005).
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

// Kurtosis of the averaged sensor signal about its mean, normal = 3; of the change signal, it rises
// when the change concentrates in few teeth. D. Dyer and R. M. Stewart, J. Mech. Des. 100 (1978),
// 229-235.
inline double turn_kurtosis(const SensorTurn& sensor) {
    return standardised_moment(sensor.turn, 4);
}

// Figure of merit zero of the vibration: peak-to-peak of the averaged sensor signal x over the sum
// of the amplitudes A of its mesh harmonics,
//
//     FM0 = (max x - min x) / sum over j >= 1 of A(j Z_p),
//
// with all harmonics below the Nyquist order. R. M. Stewart, "Some useful data analysis techniques
// for gearbox diagnostics", University of Southampton (1977); Lebold et al. (2000). It detects
// major faults, which raise single peaks or lower the mesh lines. NaN if there are no mesh lines
// apart from rounding errors.
inline double fm0(const SensorTurn& sensor) {
    constexpr double kRounding = 1e-12;  // of the peak-to-peak value
    const auto [low, high] = std::minmax_element(sensor.turn.begin(), sensor.turn.end());
    const auto mesh = static_cast<std::size_t>(sensor.mesh_order);
    double harmonics = 0.0;
    for (std::size_t order = mesh; 2 * order < sensor.turn.size(); order += mesh) {
        harmonics += sensor.amplitude[order];
    }
    const double range = *high - *low;
    return harmonics > kRounding * range ? range / harmonics : kNan;
}

}  // namespace gearpod::features
