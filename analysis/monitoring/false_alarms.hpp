// False alarms per 1000 machine hours. Thresholds are set to a stated rate on one set of healthy
// lives; the rate is then measured on lives that had no part in setting the threshold.
#pragma once

#include <limits>
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
// r is the rank of SortedSample::threshold() at a rate of `per_1000_h` times the hours per record.
// For independent records (lives of one record, or a single-value rule) the expected rate equals
// the stated one, otherwise nearly so. The rule restarts after each alarm.
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

// Alarms of measured records, whose level may drift from day to day. A detector never restarts, so
// that an alarm is one of its statistic.
//
// Drift: the means of consecutive parts of each gearbox's healthy records scatter about their mean
// with a standard deviation s. Parts are three or four sessions, separated by intervals of more
// than a tenth of the longest one, otherwise three of equal number; each has at least 5 records.
// The level of further records is taken as Student's t, with the degrees of freedom of s, times s
// (1 + 1/parts)^(1/2). Slow drifts have few independent parts: more would underestimate them.

struct TimedValue {
    double time, value;
};
using HealthyRecords = std::vector<TimedValue>;  // of one gearbox, in time order

struct RecordThreshold {
    double value = kNan;  // NaN if no healthy record has a statistic
    double rate = kNan;   // of false alarms: as stated, or the smallest that the records can set
    long records = 0;     // healthy records with a statistic
    long alarms = 0;      // of these records
    double drift = 0.0;   // of the level of statistics or, where they accumulate, of the values
    // A detector that accumulates (ewma, cusum, trend) takes of a record what its distance from the
    // healthy median `centre` exceeds `band` by, in units of `scale`, half the distance of the
    // healthy 16 and 84 % quantiles. The drift exceeds the band with the probability of a false
    // alarm. The excess counts as at most `most`, twice the range of the healthy records, and only
    // a record beyond the band alarms: a single bad one sustains no alarm. Gearboxes share the
    // centre, so that they are compared by their deviations from their own first records.
    double centre = 0.0, scale = 1.0, band = 0.0, most = std::numeric_limits<double>::infinity();
};

// Threshold of healthy records, the values of each gearbox in time order, at an expected rate of
// false alarms of further records: statistics are exceeded by their residuals about their part's
// mean and a level that drifts. For those that accumulate, and without records enough for parts, it
// is that of SortedSample::threshold().
RecordThreshold record_threshold(const Detector& detector, std::span<const HealthyRecords> healthy,
                                 double rate);

// Alarm of every record; empty for records without a value.
std::vector<std::optional<bool>> record_alarms(const Detector& detector,
                                               std::span<const double> values,
                                               const RecordThreshold& threshold);

// Median number of records up to the first alarm without a fault: 101 series of independent draws
// from the healthy records, of at most `longest` records; infinite if fewer than half of them
// alarm.
double run_length(const Detector& detector, std::span<const HealthyRecords> healthy,
                  const RecordThreshold& threshold, long longest);

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

// False alarms that had no part in setting their threshold: the first half of each gearbox's
// healthy records sets it, and the alarms of the second half are counted.
struct HeldOutAlarms {
    // False-alarm rate of the threshold: the stated one, or smallest_rate(). NaN without records or
    // without a threshold, because the detector needs more records than a half has.
    double rate = kNan;
    long alarms = 0, records = 0;
    // Exact interval of the rate for independent records (interval.hpp).
    Interval bounds{kNan, kNan};
};
GEARPOD_FIELDS(HeldOutAlarms, rate, alarms, recordings, lower_upper)
HeldOutAlarms held_out_alarms(const Detector& detector, std::span<const HealthyRecords> healthy,
                              double rate, double confidence);

}  // namespace gearpod::analysis
