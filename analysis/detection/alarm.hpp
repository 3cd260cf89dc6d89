// Which side of the threshold raises the alarm.
#pragma once

namespace gearpod::analysis {

enum class Alarm { high, low };

// Times a value: the larger, the nearer to the alarm.
constexpr double alarm_sign(Alarm alarm) {
    return alarm == Alarm::high ? 1.0 : -1.0;
}

// Strictly beyond; false if either is NaN.
constexpr bool is_alarm(double value, double threshold, Alarm alarm) {
    return alarm == Alarm::high ? value > threshold : value < threshold;
}

constexpr const char* alarm_name(Alarm alarm) {
    return alarm == Alarm::high ? "high" : "low";
}
// Of the alarm's values, before the threshold.
constexpr const char* alarm_symbol(Alarm alarm) {
    return alarm == Alarm::high ? ">" : "<";
}

}  // namespace gearpod::analysis
