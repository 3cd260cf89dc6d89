// False alarms per 1000 machine hours. Thresholds are set to a stated rate on one set of healthy
// lives; the rate is then measured on lives that had no part in setting the threshold.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/monitoring/detector.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Values of one healthy gearbox seen by a monitor.
struct HealthyLife {
    std::vector<double> values;  // in time order; NaN: a record without a value
    double hours = 0.0;          // operating time represented by the values that are not NaN
};

// Threshold of a detector and the data that set it.
struct MonitorThreshold {
    // NaN if the lives are too short for the rate, or if the detector never has a statistic.
    double value = kNan;
    long records = 0;  // records with a value
    double hours = 0.0;
    long alarms = 0;                // alarms of these lives at the threshold
    double least_per_1000_h = 0.0;  // lowest rate that these lives can set
};

// Smallest statistic above which these lives have few enough alarms. Of n records, r - 1 have none;
// r is the rank of alarm_threshold() at a rate of `per_1000_h` times the hours per record. For
// independent records (lives of one record, or a single-value rule) the expected rate equals the
// stated one, otherwise nearly so. The rule restarts after each alarm.
MonitorThreshold monitor_threshold(const Detector& detector, std::span<const HealthyLife> lives,
                                   double per_1000_h);

// Alarms of lives that had no part in setting the threshold.
struct FalseAlarms {
    long alarms = 0, records = 0;
    double hours = 0.0;
    double per_1000_h = kNan;
    // Variance of the alarm counts per life relative to that of independent alarms, at least 1.
    // Alarms cluster where a gearbox has learnt a poor baseline.
    double dispersion = 1.0;
    // Tail probability of each bound; smaller where few lives determine the variance.
    double tail = 0.025;
    // Bounds of the rate at this threshold: exact for independent alarms, from the scatter between
    // lives for clustered ones.
    Interval bounds{kNan, kNan};
};
FalseAlarms false_alarms(const Detector& detector, std::span<const HealthyLife> lives,
                         double threshold, double confidence);

// Interval of the expected rate per 1000 h over repeated campaigns that each set their own
// threshold, at the confidence of `seen`. Applies expected_rate_interval() to the effective number
// of independent records, the number divided by the dispersion. The stated rate should lie in the
// interval.
Interval expected_per_1000_h(const MonitorThreshold& threshold, const FalseAlarms& seen);

// Sustained alarms: alarms after which most of the next records alarm, too. A single bad record
// does not sustain one.

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
// rate of a threshold at the largest of them (threshold.hpp).
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
