// Side of the threshold that raises the alarm.
#pragma once

#include "features/feature.hpp"

namespace gearpod::analysis {

using Alarm = features::AlarmSide;

// Side on which a fault is missed.
constexpr Alarm opposite(Alarm alarm) {
    return alarm == Alarm::high ? Alarm::low : Alarm::high;
}

// Sign that makes the larger value the one nearer to the alarm.
constexpr double alarm_sign(Alarm alarm) {
    return alarm == Alarm::high ? 1.0 : -1.0;
}

// True strictly beyond the threshold; false if either value is NaN.
constexpr bool is_alarm(double value, double threshold, Alarm alarm) {
    return alarm == Alarm::high ? value > threshold : value < threshold;
}

constexpr const char* alarm_name(Alarm alarm) {
    return alarm == Alarm::high ? "high" : "low";
}
// Comparison sign between an alarming value and the threshold.
constexpr const char* alarm_symbol(Alarm alarm) {
    return alarm == Alarm::high ? ">" : "<";
}

}  // namespace gearpod::analysis
