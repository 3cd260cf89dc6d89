// Figure of merit four: kurtosis of the difference signal, normal = 3. Stewart (1977); Lebold et
// al. (2000); Samuel and Pines (2005).
#pragma once

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

inline double fm4(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 4);
}

inline double te_fm4(const TeParts& te) {
    return standardised_moment(te.difference, 4);
}

}  // namespace gearpod::features
