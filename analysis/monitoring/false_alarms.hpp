// False alarms per 1000 machine hours: thresholds set to a stated number of them on healthy lives,
// and how many there are on lives that had no part in it.
#pragma once

#include <span>
#include <vector>

#include "analysis/monitoring/detector.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// What a monitor sees of one healthy gearbox.
struct HealthyLife {
    std::vector<double> values;  // in time order; NaN: a record that it does not see
    double hours = 0.0;          // that the values which are not NaN stand for
};

// A detector's threshold.
struct MonitorThreshold {
    // NaN if the lives are too short for the rate, or for the detector to say anything.
    double value = kNan;
    long records = 0;     // seen by the monitor
    double hours = 0.0;
    long alarms = 0;                // of these lives beyond it
    double least_per_1000_h = 0.0;  // what these lives could set
};

// The smallest statistic beyond which these lives have few enough alarms: of n records r - 1 are
// none, r the rank of alarm_threshold() at a rate of `per_1000_h` times the hours of a record. Of
// records that are independent, so that a life of one record or a single-value rule, the expected
// rate is then the stated one; of the others nearly so. Each alarm starts the rule anew.
MonitorThreshold monitor_threshold(const Detector& detector, std::span<const HealthyLife> lives,
                                   double per_1000_h);

// Alarms of lives that had no part in the threshold.
struct FalseAlarms {
    long alarms = 0, records = 0;
    double hours = 0.0;
    double per_1000_h = kNan;
    // Variance of the lives' counts over that of independent alarms, at least 1: alarms come in
    // clusters where a gearbox has learnt a poor baseline.
    double dispersion = 1.0;
    double tail = 0.025;  // of each side of the bounds: smaller where few lives make the variance
    // Of this threshold's rate: exact for independent alarms, for clusters by the lives' own
    // scatter.
    Interval bounds{kNan, kNan};
};
FalseAlarms false_alarms(const Detector& detector, std::span<const HealthyLife> lives,
                         double threshold, double confidence);

// Interval of the expected rate per 1000 h over repeated campaigns, each with a threshold of its
// own, at the confidence of `seen`: expected_rate_interval() of as many records as are independent
// by the dispersion. What was stated should lie in it.
Interval expected_per_1000_h(const MonitorThreshold& threshold, const FalseAlarms& seen);

}  // namespace gearpod::analysis
