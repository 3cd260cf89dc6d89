// M8A: eighth moment of the difference signal over the fourth power of its variance, normal = 105.
// Martin (1989); Lebold et al. (2000); Samuel and Pines (2005).
#pragma once

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

inline double m8a(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 8);
}

inline double te_m8a(const TeParts& te) {
    return standardised_moment(te.difference, 8);
}

}  // namespace gearpod::features
