// Features from filters that are fitted to the averaged sensor signal: linear prediction and
// minimum-entropy deconvolution.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"
#include "signals/prediction/inverse_filters.hpp"

namespace gearpod::features {

// Empty if the signal without its mean is rounding errors.
inline std::vector<double> turn_about_mean(const SensorTurn& sensor) {
    const double sum = std::accumulate(sensor.turn.begin(), sensor.turn.end(), 0.0);
    std::vector<double> x(sensor.turn.begin(), sensor.turn.end());
    for (double& value : x) {
        value -= sum / static_cast<double>(x.size());
    }
    return is_rounding(x, sensor.turn) ? std::vector<double>() : x;
}

// Kurtosis of the prediction error of an autoregressive model of the averaged sensor signal, normal
// = 3. W. Wang and A. K. Wong, J. Vib. Acoust. 124 (2002) 172-179. The model predicts the regular
// meshing from the samples before; the impulse of a tooth fault remains in the error
//
//     e_i = x_i - sum over j = 1 to p of a_j x_(i-j),
//
// where x is the average without its mean, periodic over the turn. The coefficients minimise the
// mean of e^2 (Yule-Walker equations of the circular autocorrelation, inverse_filters.hpp). The
// order p is two mesh periods of samples, at most a quarter of the turn: one mesh period would
// suffice for all mesh harmonics, two add their sidebands. NaN if x is rounding errors of the turn.
inline double ar_residual_kurtosis(const SensorTurn& sensor) {
    const std::vector<double> x = turn_about_mean(sensor);
    if (x.empty()) {
        return kNan;
    }
    const std::size_t per_mesh = x.size() / static_cast<std::size_t>(sensor.mesh_order);
    const std::size_t order = std::min(2 * per_mesh, x.size() / 4);
    signals::PeriodicSignal signal(x);
    const std::vector<double> r = signal.corrected_autocorrelation(order + 1);
    const std::vector<double> a =
        signals::solve_toeplitz(std::span(r).first(order), std::span(r).subspan(1, order));
    std::vector<double> error_filter{1.0};
    for (const double coefficient : a) {
        error_filter.push_back(-coefficient);
    }
    return standardised_moment(signal.filtered(error_filter), 4);
}

// Kurtosis, normal = 3, of the averaged sensor signal after minimum-entropy deconvolution
// (signals/prediction/inverse_filters.hpp): Endo and Randall (2007). The filter undoes the path
// from the tooth to the sensor, which smears an impulse. It has the length of a mesh period, at
// most an eighth of the turn, and 10 iterations: fixed numbers, so that equal records have equal
// values. A filter can make an impulse of noise, too; healthy values are therefore above 3. NaN if
// the average about its mean is rounding errors.
inline double med_kurtosis(const SensorTurn& sensor) {
    constexpr int kIterations = 10;
    const std::vector<double> x = turn_about_mean(sensor);
    if (x.empty()) {
        return kNan;
    }
    const std::size_t per_mesh = x.size() / static_cast<std::size_t>(sensor.mesh_order);
    const std::size_t length = std::max<std::size_t>(2, std::min(per_mesh, x.size() / 8));
    return standardised_moment(signals::deconvolve(x, length, kIterations), 4);
}

}  // namespace gearpod::features
