// Performance of a monitor over lives: share of cracks found before the tooth breaks, crack depth
// at detection, warning time, and false alarms.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"

namespace gearpod::analysis {

// Values of one gearbox with a growing crack, as seen by a monitor.
struct CrackedLife {
    std::vector<double> values;        // deviations in time order; NaN: a record without a value
    std::vector<double> hours, sizes;  // of each record
    std::size_t first = 0;             // first record with the crack
    std::optional<double> end_hours;   // empty: still running at the last record
};

// Quantile over lives. Lives in which the crack was not found count as infinite.
struct LifeQuantile {
    double value = kNan;  // infinite if too few cracks are found
    double bound = kNan;  // upper bound, one-sided at the confidence; NaN with too few lives
};

struct MonitorPerformance {
    MonitorThreshold threshold;
    FalseAlarms false_alarms;
    Interval expected_per_1000_h;  // the stated rate should lie in it
    // Lives that end within their records; those of them with an alarm before the end.
    long ended = 0, found = 0;
    double share = kNan;
    Interval share_bounds{kNan, kNan};  // Wilson interval
    // Share found by chance: the share of healthy lives that alarm within as many records from the
    // same record on.
    double share_by_chance = kNan;
    // Share found by alarms that come at random at the stated rate.
    double share_at_stated_rate = kNan;
    LifeQuantile size_50, size_90;  // crack size at detection, over the lives that end
    // Hours from the alarm to the end over the lives found: the median, and the time exceeded by
    // nine in ten.
    double warning_50 = kNan, warning_90 = kNan;
    // Time of the first alarm after the crack's initiation for each cracked life; NaN if there is
    // none.
    std::vector<double> alarm_hours;
};

// Evaluates a detector: threshold from `setting`, false alarms from `healthy`, everything else from
// `cracked`. An alarm before the crack's initiation counts as false, and the detector restarts
// after it.
MonitorPerformance monitor_performance(const Detector& detector,
                                       std::span<const HealthyLife> setting,
                                       std::span<const HealthyLife> healthy,
                                       std::span<const CrackedLife> cracked, double per_1000_h,
                                       double confidence);

// Smallest order statistic that exceeds the quantile with the given probability (ISO 16269-7).
// Values may be infinite. NaN with too few values.
double quantile_bound(std::vector<double> values, double quantile, double confidence);

}  // namespace gearpod::analysis
