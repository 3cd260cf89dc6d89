// Sustained alarms: alarms after which most of the next records alarm, too. A single bad record
// does not sustain one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct SustainedRule {
    int records = 10;    // k, the next records that count
    double share = 0.8;  // least share of them that alarms

    int needed() const;  // least number of them
};
GEARPOD_FIELDS(SustainedRule, records, share)

// Alarm of every record; empty for records without a value. Detectors that accumulate (ewma, cusum,
// trend) restart after an alarm, so that each record must raise the alarm anew; a window of the
// last n records moves on.
std::vector<std::optional<bool>> record_alarms(const Detector& detector,
                                               std::span<const double> values, double threshold);

struct SustainedAlarm {
    std::size_t first = 0;      // record of the alarm
    std::size_t confirmed = 0;  // record at which enough of the next ones have alarmed
};

// Sustained alarms in order; the next one begins after the records that confirm this one. Records
// without a value do not count.
std::vector<SustainedAlarm> sustained_alarms(std::span<const std::optional<bool>> alarms,
                                             const SustainedRule& rule);

// Smallest false-alarm rate per record that n healthy records can set, 1 / (n + 1): the expected
// rate of a threshold at the largest of them (false_alarm_rate.hpp).
double smallest_rate(long healthy_records);

// False alarms that had no part in setting their threshold: the first half of each healthy life
// sets it, and the alarms of the second half are counted. With a feature that drifts they exceed
// the stated rate.
struct HeldOutAlarms {
    // False-alarm rate of the threshold: the stated one, or smallest_rate(). NaN without records or
    // without a threshold, because the detector needs more records than a half has.
    double rate = kNan;
    long alarms = 0, records = 0;
    // Exact interval of the rate for independent records (interval.hpp).
    Interval bounds{kNan, kNan};
};
GEARPOD_FIELDS(HeldOutAlarms, rate, alarms, recordings, lower_upper)
HeldOutAlarms held_out_alarms(const Detector& detector, std::span<const HealthyLife> lives,
                              double rate, double confidence);

// Drift of a level over time: Theil-Sen estimate of its change from first to last value (the median
// slope of all pairs), relative to the median, and Kendall's tau with its normal p-value for
// independent values. P. K. Sen, J. Am. Stat. Assoc. 63 (1968), 1379-1389; M. G. Kendall,
// Biometrika 30 (1938), 81-93. Of more than 1000 values, equally spaced ones are used. All
// results are NaN for fewer than 10 values.
struct Drift {
    double change = kNan;
    double tau = kNan, p_value = kNan;  // two-sided
};
GEARPOD_FIELDS(Drift, change, tau, p_value)
Drift drift_of(std::span<const double> values);

}  // namespace gearpod::analysis
