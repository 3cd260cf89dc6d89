// Alarm threshold from a healthy sample at a stated false-alarm rate.
#pragma once

#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

struct Threshold {
    double value = 0.0;  // NaN if the sample is too small for the rate
    long sample = 0;     // finite healthy values
    long alarms = 0;     // of these, how many lie beyond it
};

// The ceil((n+1)(1-rate))-th smallest of n values (for a low alarm: largest). A further healthy
// gearbox from the same population lies strictly beyond the r-th smallest of n with an expected
// probability of (n+1-r)/(n+1) whatever the distribution, so this is the tightest order statistic
// that keeps the rate. Values that are not finite are left out. Needs n >= 1/rate - 1.
Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate);

// Strictly beyond; false if either is NaN.
bool is_alarm(double value, double threshold, Alarm alarm);

}  // namespace gearpod::analysis
