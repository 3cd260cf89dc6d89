// Performance of a monitor over lives: share of cracks found before the tooth breaks, crack depth
// at detection, warning time, and false alarms.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/monitoring/crack_effect.hpp"

namespace gearpod::analysis {

// Quantile over lives. Lives in which the crack was not found count as infinite.
struct LifeQuantile {
    double value = kNan;  // infinite if too few cracks are found
    double bound = kNan;  // upper bound, one-sided at the confidence; NaN with too few lives
};

struct MonitorPerformance {
    MonitorThreshold threshold;
    FalseAlarms false_alarms;
    Interval expected_per_1000_h;  // the stated rate should lie in it
    // Size from which the crack has an effect on the values (crack_effect.hpp). Time in hours that
    // cracked lives spend below it, and alarms in it, which are false.
    double effect_size = kNan;
    double early_hours = 0.0;
    long early_alarms = 0;
    // Lives that end within their records; those of them with an alarm after the crack's effect and
    // before the end.
    long ended = 0, found = 0;
    double share = kNan;
    Interval share_bounds{kNan, kNan};  // Wilson interval
    // Share found by chance: the share of healthy lives that alarm within as many records from the
    // same record on, that of the crack's effect.
    double share_by_chance = kNan;
    // Share found by alarms that come at random at the stated rate.
    double share_at_stated_rate = kNan;
    LifeQuantile size_50, size_90;  // crack size at detection, over the lives that end
    // Hours from the alarm to the end over the lives found: the median, and the time exceeded by
    // nine in ten.
    double warning_50 = kNan, warning_90 = kNan;
    // Time of the first alarm after the crack's effect for each cracked life; NaN if there is none.
    std::vector<double> alarm_hours;
};

// Evaluates a detector: threshold from `setting`, false alarms from `healthy`, everything else from
// `cracked`. An alarm before the record at which the crack reaches the size of its effect counts as
// false, and the detector restarts after it.
MonitorPerformance monitor_performance(const Detector& detector,
                                       std::span<const HealthyLife> setting,
                                       std::span<const HealthyLife> healthy,
                                       std::span<const CrackedLife> cracked, double per_1000_h,
                                       double confidence);

// Smallest order statistic that exceeds the quantile with the given probability (ISO 16269-7).
// Values may be infinite. NaN with too few values.
double quantile_bound(std::vector<double> values, double quantile, double confidence);

}  // namespace gearpod::analysis
