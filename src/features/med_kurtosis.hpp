// Kurtosis, normal = 3, of the averaged sensor signal after minimum-entropy deconvolution
// (signals/prediction/deconvolution.hpp): Endo and Randall (2007). The filter undoes the path from
// the tooth to the sensor, which smears an impulse. It has the length of a mesh period, at most an
// eighth of the turn, and 10 iterations: fixed numbers, so that equal records have equal values. A
// filter can make an impulse of noise, too; healthy values are therefore above 3. NaN if the
// average about its mean is rounding errors.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "features/averaged_turn.hpp"
#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"
#include "signals/prediction/deconvolution.hpp"

namespace gearpod::features {

inline double med_kurtosis(const SensorTurn& sensor) {
    constexpr int kIterations = 10;
    const std::vector<double> x = turn_about_mean(sensor);
    if (x.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const std::size_t per_mesh = x.size() / static_cast<std::size_t>(sensor.mesh_order);
    const std::size_t length = std::max<std::size_t>(2, std::min(per_mesh, x.size() / 8));
    return standardised_moment(signals::deconvolve(x, length, kIterations), 4);
}

}  // namespace gearpod::features
