// Alarm threshold from a healthy sample at a stated false-alarm rate.
#pragma once

#include <optional>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/tail.hpp"
#include "analysis/detection/tilted_sample.hpp"

namespace gearpod::analysis {

struct Threshold {
    double value = 0.0;  // NaN if the sample is too small for the rate
    long sample = 0;     // finite healthy values
    long alarms = 0;     // of these, how many lie beyond it
    // Where it is no order statistic: the law of the largest values, of smallest ones negated.
    std::optional<TailFit> tail;
    // Where it is from tilted records, of so many gearboxes.
    std::optional<TiltedSample::Estimate> tilted = {};
    long gearboxes = 0;
};

// The ceil((n+1)(1-rate))-th smallest of n values (for a low alarm: largest). A further healthy
// gearbox from the same population lies strictly beyond the r-th smallest of n with an expected
// probability of (n+1-r)/(n+1) whatever the distribution, so this is the tightest order statistic
// that keeps the rate. Where that needs more than n values, the tail's extrapolation, as far as it
// reaches (tail.hpp). Values that are not finite are left out.
Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate);

// The false-alarm rate of this threshold, as its own sample and `alarms` of `tested` further
// healthy gearboxes know it; of tilted records as they alone do. NaN without a threshold.
HealthyRate rate_of(const Threshold& threshold, Alarm alarm, double false_alarm_rate, long alarms,
                    long tested, double confidence);

// Where the value may lie that is exceeded with exactly the rate asked for: order statistics, or of
// the tail. The side where neither reaches is infinite.
Interval threshold_interval(const std::vector<double>& healthy, Alarm alarm,
                            double false_alarm_rate, double confidence);

// The largest finite values, of a low alarm the smallest ones negated: `exceedances` of them after
// the one that they exceed, ascending. All of them if there are no more.
std::vector<double> largest_values(std::vector<double> healthy, Alarm alarm, long exceedances);

}  // namespace gearpod::analysis
