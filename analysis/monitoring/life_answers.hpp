// What a monitor is worth: how many cracks it finds before the tooth goes, how deep they are then
// and how long before, at which cost in false alarms.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"

namespace gearpod::analysis {

// One gearbox whose crack grows, as a monitor sees it.
struct CrackedLife {
    std::vector<double> values;  // deviations in time order; NaN: a record that it does not see
    std::vector<double> hours, sizes;  // of each record
    std::size_t first = 0;             // the first record with the crack
    std::optional<double> end_hours;   // empty: still running at the last record
};

// A quantile over lives, those that were not found beyond all sizes.
struct LifeQuantile {
    double value = kNan;  // infinite: that many are not found
    double bound = kNan;  // upper, one-sided at the confidence; NaN of too few lives
};

struct LifeAnswers {
    MonitorThreshold threshold;
    FalseAlarms false_alarms;
    Interval expected_per_1000_h;  // what was stated should lie in it
    long ended = 0, found = 0;     // lives that end within their records; of these found before
    double share = kNan;
    Interval share_bounds{kNan, kNan};  // Wilson's
    // What would be found of lives as long were they healthy: the share of healthy ones that alarm
    // on as many records behind the same one.
    double share_by_chance = kNan;
    LifeQuantile size_50, size_90;  // at detection, over the lives that end
    // Hours from the alarm to the end, of those found: median, and what nine in ten have.
    double warning_50 = kNan, warning_90 = kNan;
    // Of each cracked life the first alarm behind the crack's begin; NaN of none.
    std::vector<double> alarm_hours;
};

// Thresholds from `setting`, false alarms on `healthy`, all else of `cracked`. An alarm before the
// crack is a false one, after which the detector starts anew.
LifeAnswers answer(const Detector& detector, std::span<const HealthyLife> setting,
                   std::span<const HealthyLife> healthy, std::span<const CrackedLife> cracked,
                   double per_1000_h, double confidence);

// The least order statistic that lies above the quantile with this probability, of values that
// need not be finite: ISO 16269-7. NaN where there are too few.
double quantile_bound(std::vector<double> values, double quantile, double confidence);

}  // namespace gearpod::analysis
