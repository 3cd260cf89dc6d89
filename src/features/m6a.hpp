// M6A: sixth moment of the difference signal over the cube of its variance, normal = 15. Martin
// (1989); Lebold et al. (2000); Samuel and Pines (2005).
#pragma once

#include "features/signals.hpp"
#include "features/statistics/standardised_moment.hpp"

namespace gearpod::features {

inline double m6a(const SensorTurn& sensor) {
    return standardised_moment(sensor.difference, 6);
}

inline double te_m6a(const TeParts& te) {
    return standardised_moment(te.difference, 6);
}

}  // namespace gearpod::features
