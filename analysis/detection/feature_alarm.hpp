// Side of the threshold on which a feature raises its alarm.
#pragma once

#include "analysis/detection/detection.hpp"
#include "features/feature.hpp"

namespace gearpod::analysis {

constexpr Alarm alarm_of(const features::Feature& feature) {
    return feature.alarm == features::AlarmSide::low ? Alarm::low : Alarm::high;
}
// Opposite side, on which a fault is missed.
constexpr Alarm miss_of(const features::Feature& feature) {
    return alarm_of(feature) == Alarm::high ? Alarm::low : Alarm::high;
}

}  // namespace gearpod::analysis
