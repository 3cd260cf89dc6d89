// False alarms per 1000 machine hours. Thresholds are set to a stated rate on one set of healthy
// lives; the rate is then measured on lives that had no part in setting the threshold.
#pragma once

#include <span>
#include <vector>

#include "analysis/monitoring/detector.hpp"
#include "analysis/statistics/interval.hpp"

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

}  // namespace gearpod::analysis
