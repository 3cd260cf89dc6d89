// Kurtosis of the prediction error of an autoregressive model of the averaged sensor signal, normal
// = 3. W. Wang and A. K. Wong, J. Vib. Acoust. 124 (2002) 172-179. The model predicts the regular
// meshing from the samples before; the impulse of a tooth fault remains in the error
//
//     e_i = x_i - sum over j = 1 to p of a_j x_(i-j),
//
// where x is the average without its mean, periodic over the turn. The coefficients minimise the
// mean of e^2 (Yule-Walker equations of the circular autocorrelation, toeplitz.hpp). The order p is
// two mesh periods of samples, at most a quarter of the turn: one mesh period would suffice for all
// mesh harmonics, two add their sidebands. NaN if x is rounding errors of the turn.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "features/averaged_turn.hpp"
#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"
#include "signals/prediction/periodic_signal.hpp"
#include "signals/prediction/toeplitz.hpp"

namespace gearpod::features {

inline double ar_residual_kurtosis(const SensorTurn& sensor) {
    const std::vector<double> x = turn_about_mean(sensor);
    if (x.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
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

}  // namespace gearpod::features
