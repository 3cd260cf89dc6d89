// Alarm sides, size groups, and the tables of thresholds and detection rates of a feature.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.hpp"
#include "features/feature.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Side of the threshold that raises the alarm.
using Alarm = features::AlarmSide;

// Side on which a fault is missed.
constexpr Alarm opposite(Alarm alarm) {
    return alarm == Alarm::high ? Alarm::low : Alarm::high;
}

// Sign that makes the larger value the one nearer to the alarm.
constexpr double alarm_sign(Alarm alarm) {
    return alarm == Alarm::high ? 1.0 : -1.0;
}

// True strictly beyond the threshold; false if either value is NaN.
constexpr bool is_alarm(double value, double threshold, Alarm alarm) {
    return alarm == Alarm::high ? value > threshold : value < threshold;
}

constexpr const char* alarm_name(Alarm alarm) {
    return alarm == Alarm::high ? "high" : "low";
}
// Comparison sign between an alarming value and the threshold.
constexpr const char* alarm_symbol(Alarm alarm) {
    return alarm == Alarm::high ? ">" : "<";
}

// Request and results of a detection: thresholds, counts and rates by feature, noise level and
// fault size.

// Group of gearboxes whose fault sizes lie in [low, high], in the unit of the request. Both are
// equal for a fixed level.
struct SizeGroup {
    double low = 0.0;
    double high = 0.0;
};

// Detections in one size group at one noise level.
struct DetectionCell {
    SizeGroup size;
    long tested = 0;     // gearboxes with a finite feature value
    long detected = 0;   // number of alarms among them
    long failed = 0;     // gearboxes without a value (diverged, or the feature is not a number)
    double pd = 0.0;     // detected / tested; NaN if none was tested
    double lower = 0.0;  // Wilson bounds at the requested confidence
    double upper = 0.0;
    Interval exact = {};  // Clopper-Pearson bounds, wider
};
GEARPOD_FIELDS(DetectionCell, size_low_high, tested, detected, failed, pd, lower, upper, exact)

// Fit of a generalised Pareto distribution to the largest healthy values (the smallest for a low
// alarm).
struct TailChoice {
    long exceedances = 0;  // number of values that it is fitted to
    double above = 0.0;    // value that they exceed, in the feature's unit
    double shape = 0.0, scale = 0.0;
    double threshold = 0.0;  // threshold from this fit
    double rate = 0.0;       // expected rate of this fit beyond the threshold in use
};
GEARPOD_FIELDS(TailChoice, exceedances, above, shape, scale, threshold, rate)

// Threshold extrapolated beyond the healthy sample (threshold.hpp).
struct TailThreshold {
    double extrapolation = 1.0;       // 1 / (rate x sample size)
    std::vector<TailChoice> choices;  // the first gives the threshold; the others fit fewer values
    bool steady = true;  // the rates of the other fits lie in the interval of the threshold's rate
};
GEARPOD_FIELDS(TailThreshold, extrapolation, choices, steady)

// Threshold from importance-sampled records (importance_sample.hpp).
struct ImportanceSampledThreshold {
    long gearboxes = 0;
    double contributing = 0.0;   // effective number of gearboxes that contribute to the rate
    double extrapolation = 1.0;  // 1 / (rate x number of gearboxes)
};
GEARPOD_FIELDS(ImportanceSampledThreshold, gearboxes, carrying, extrapolation)

// Results of one feature at one noise level.
struct LevelDetection {
    double noise_level = 0.0;           // factor on the sensor and encoder noise
    double threshold = 0.0;             // in the feature's unit; NaN without one
    long threshold_sample = 0;          // healthy records with a value that set it
    long threshold_alarms = 0;          // number of them beyond the threshold
    std::optional<TailThreshold> tail;  // set if the threshold was extrapolated
    std::optional<ImportanceSampledThreshold> importance_sampled =
        {};                            // set if the threshold is from importance sampling
    std::vector<DetectionCell> cells;  // by ascending size
    // Interval of the false-alarm rate of this threshold from the healthy sample alone, whatever
    // the feature's distribution (threshold.hpp, threshold.hpp).
    Interval threshold_rate = {};
    // False-alarm rate of this threshold with the healthy test gearboxes included, its interval,
    // and the interval of the expected rate over repeated studies, threshold scatter included. The
    // last is NaN without healthy test gearboxes and for an extrapolated or importance-sampled
    // threshold. Where healthy values equal the threshold, only the upper bound of threshold_rate
    // is valid and expected_rate is NaN. healthy_rate_bounds is then the Clopper-Pearson interval
    // of the test gearboxes, or of the healthy sample if there are none.
    double healthy_rate = 0.0;
    Interval healthy_rate_bounds = {};
    Interval expected_rate = {};
    double healthy_median = kNan;  // upper median of the healthy sample's values
};
GEARPOD_FIELDS(LevelDetection, noise_level, threshold, threshold_sample, threshold_alarms, tail,
               tilted, sizes, threshold_rate, healthy_rate, healthy_rate_bounds, expected_rate,
               healthy_median_)

struct FeatureDetection {
    std::string feature;
    Alarm alarm = Alarm::high;
    std::vector<LevelDetection> levels;  // by ascending noise level
    // For example a threshold sample too small for the requested rate.
    std::vector<std::string> warnings;
};
GEARPOD_FIELDS(FeatureDetection, name, alarm, levels, warnings)

// Name, unit and displayed unit of the fault size: metres are shown in mm, other units unchanged.
struct SizeUnit {
    std::string name = "fault_size";  // parameter that holds a gearbox's fault size
    std::string unit = "m";           // unit of its values: "m", or "1" for a pure number

    std::string shown_unit() const { return unit == "m" ? "mm" : unit == "1" ? "" : unit; }
    double per_unit() const { return unit == "m" ? 1e-3 : 1.0; }  // shown = value / per_unit
};
GEARPOD_FIELDS(SizeUnit, name, unit)

struct DetectionRequest {
    double false_alarm_rate = 0.05;
    double confidence = 0.95;
    std::vector<double> noise_levels;
    std::vector<SizeGroup> groups;  // ascending; from levels or from edges
    SizeUnit size = {};
    // Epistemic inputs (columns of the gearboxes): their distribution describes the uncertainty
    // about one value that all gearboxes share.
    std::vector<std::string> uncertain = {};
    // Number of consecutive rows per gearbox of the threshold sample: records that differ in noise.
    std::size_t threshold_records = 1;
    bool importance_sampling =
        false;  // importance sampling for the records of accelerometer features
};

}  // namespace gearpod::analysis
