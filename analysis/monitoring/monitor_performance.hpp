// How early monitoring finds cracks: sizes at which half and 90 % of lives have an alarm, false
// alarms, and the ranking of features and detectors by them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Values of one gearbox with a growing crack, as seen by a monitor.
struct CrackedLife {
    std::vector<double> values;        // deviations in time order; NaN: a record without a value
    std::vector<double> hours, sizes;  // of each record
    std::size_t first = 0;             // first record with the crack
    std::optional<double> end_hours;   // empty: still running at the last record
};

// The crack has an effect if the median or the 90 % quantile of the values has risen above that of
// healthy values by this many standard deviations of healthy values.
inline constexpr double kEffectDeviations = 0.5;

// Smallest size at and above which the crack has an effect on the values. The records with a crack
// are divided into at most 20 groups of equal number by size, of at least 40 records each where
// there are as many; the result is the smallest size in the first group from which on all groups
// have moved. Infinite if the largest cracks have no effect; NaN without healthy values.
// `two_sided`: a fall of the median or of the 10 % quantile counts as well. The healthy standard
// deviation is half the distance of the 16 and 84 % quantiles.
double effect_size(std::span<const HealthyLife> healthy, std::span<const CrackedLife> cracked,
                   bool two_sided);

// Performance of a monitor over lives: share of cracks found before the tooth breaks, crack depth
// at detection, warning time, and false alarms.

// Quantile over lives. Lives in which the crack was not found count as infinite.
struct LifeQuantile {
    double value = kNan;  // infinite if too few cracks are found
    double bound = kNan;  // upper bound, one-sided at the confidence; NaN with too few lives
};

struct MonitorPerformance {
    MonitorThreshold threshold;
    FalseAlarms false_alarms;
    Interval expected_per_1000_h;  // the stated rate should lie in it
    // Size from which the crack has an effect on the values. Time in hours that
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
GEARPOD_FIELDS(MonitorPerformance, threshold_, false_alarms_, expected_, effect_depth_m,
               early_hours, early_alarms, ended, found, share, share_bounds, share_by_chance,
               share_at_stated_rate, size_50_, size_90_, warning_50_h, warning_90_h, alarm_h_)

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

// Order of monitored features and detectors by what they find net of chance.

// Probability with which a detector that alarms at random is taken for one that finds cracks.
inline constexpr double kChanceLevel = 1e-3;

// Share found less the share that false alarms find in lives of the same length: that of the
// healthy lives, or, if none were counted, that of alarms at the stated rate. NaN if unknown.
double net_share(const MonitorPerformance& performance);

// Reason why a detector has no rank, or "": it has no threshold, no tooth fails, its false alarms
// exceed the stated rate (the lower bound of their interval lies above it), or it finds no more
// than chance. The last is a one-sided binomial test at the level kChanceLevel against the
// larger of the share of the healthy lives and that of the stated rate.
std::string why_unranked(const MonitorPerformance& performance, double per_1000_h);

// True if `a` ranks before `b`: it finds more net of chance; or as much at a smaller size (90 %,
// then 50 %); or at equal sizes with fewer false alarms.
bool ranks_before(const MonitorPerformance& a, const MonitorPerformance& b);

}  // namespace gearpod::analysis
