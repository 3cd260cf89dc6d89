// NA4: fourth moment of the residual signal over the squared mean variance of the residual signals
// of M earlier records; Zakrajsek, Townsend and Decker, NASA TM-105950 (1993). Here the earlier
// records are those of M healthy gearboxes (mc/gearbox/healthy_reference.hpp). This is the NA4 of a
// gearbox that resembled them when its record began; a healthy one has about 3.
#pragma once

#include "features/signals.hpp"
#include "features/statistics/trending.hpp"

namespace gearpod::features {

inline double na4(const SensorTurn& sensor, const HealthyRecords& healthy) {
    return trended_kurtosis(sensor.residual, healthy.residual_variance);
}

}  // namespace gearpod::features
