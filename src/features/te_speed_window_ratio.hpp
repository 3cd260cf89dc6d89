// Largest over median RMS of the speed error (signals/spectra/speed_error.hpp) in windows of one
// mesh period, one from every sample of the averaged turn on. It localises the change of speed at a
// faulty tooth: X. Song et al., Modern Mech. Eng. 14 (2024) 39-50. 1 for regular meshing. NaN if
// the median is zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "features/signals.hpp"
#include "features/statistics/median.hpp"
#include "signals/spectra/speed_error.hpp"

namespace gearpod::features {

inline double te_speed_window_ratio(const TeParts& te) {
    const std::vector<double> speed = signals::speed_error(te.turn);
    const std::size_t per_mesh = speed.size() / static_cast<std::size_t>(te.mesh_order);
    std::vector<double> rms;
    for (std::size_t first = 0; first < speed.size(); ++first) {
        double squares = 0.0;
        for (std::size_t i = 0; i < per_mesh; ++i) {
            const double value = speed[(first + i) % speed.size()];
            squares += value * value;
        }
        rms.push_back(std::sqrt(squares / static_cast<double>(per_mesh)));
    }
    const double largest = *std::ranges::max_element(rms);
    const double middle = median(std::move(rms));
    return middle > 0.0 ? largest / middle : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gearpod::features
