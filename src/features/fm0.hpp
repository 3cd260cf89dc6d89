// Figure of merit zero of the vibration: peak-to-peak of the averaged sensor signal x over the sum
// of the amplitudes A of its mesh harmonics,
//
//     FM0 = (max x - min x) / sum over j >= 1 of A(j Z_p),
//
// with all harmonics below the Nyquist order. R. M. Stewart, "Some useful data analysis techniques
// for gearbox diagnostics", University of Southampton (1977); Lebold et al. (2000). It detects
// major faults, which raise single peaks or lower the mesh lines. NaN if there are no mesh lines
// apart from rounding errors.
#pragma once

#include <algorithm>
#include <limits>

#include "features/signals.hpp"

namespace gearpod::features {

inline double fm0(const SensorTurn& sensor) {
    constexpr double kRounding = 1e-12;  // of the peak-to-peak value
    const auto [low, high] = std::minmax_element(sensor.turn.begin(), sensor.turn.end());
    const auto mesh = static_cast<std::size_t>(sensor.mesh_order);
    double harmonics = 0.0;
    for (std::size_t order = mesh; 2 * order < sensor.turn.size(); order += mesh) {
        harmonics += sensor.amplitude[order];
    }
    const double range = *high - *low;
    return harmonics > kRounding * range ? range / harmonics
                                         : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gearpod::features
