// What is asked of a detection, and what it gives: thresholds, counts and rates by feature, noise
// level and fault size.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/detection/alarm.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// One group of gearboxes whose fault sizes lie in [low, high], in the request's unit; both are
// equal for a fixed level.
struct SizeGroup {
    double low = 0.0;
    double high = 0.0;
};

// Detections in one size group at one noise level.
struct DetectionCell {
    SizeGroup size;
    long tested = 0;     // gearboxes with a finite feature value
    long detected = 0;   // of these, alarms
    long failed = 0;     // gearboxes without a value (diverged, or the feature is not a number)
    double pd = 0.0;     // detected / tested; NaN if none was tested
    double lower = 0.0;  // Wilson bounds at the confidence asked for
    double upper = 0.0;
    Interval exact = {};  // Clopper-Pearson bounds, wider
};

// One fit of a generalised Pareto law to the largest healthy values (of a low alarm: the smallest).
struct TailChoice {
    long exceedances = 0;  // values that it is fitted to
    double above = 0.0;    // the value that they lie beyond, in the feature's unit
    double shape = 0.0, scale = 0.0;
    double threshold = 0.0;  // that this fit would set
    double rate = 0.0;       // that it expects beyond the threshold that was set
};

// A threshold beyond its healthy sample (tail.hpp).
struct TailThreshold {
    double extrapolation = 1.0;       // so many times rarer than one in the sample is the rate
    std::vector<TailChoice> choices;  // the first set the threshold; the others fit fewer values
    bool steady = true;  // the others' rates lie in the interval of the threshold's rate
};

// A threshold from tilted records (tilted_sample.hpp).
struct TiltedThreshold {
    long gearboxes = 0;
    double carrying = 0.0;       // gearboxes that have the alarms
    double extrapolation = 1.0;  // so many times rarer than one in the gearboxes is the rate
};

// One feature at one noise level.
struct LevelDetection {
    double noise_level = 0.0;           // factor on the sensor and encoder noise
    double threshold = 0.0;             // in the feature's unit; NaN if the sample was too small
    long threshold_sample = 0;          // healthy gearboxes that set it
    long threshold_alarms = 0;          // of these, how many lie beyond it
    std::optional<TailThreshold> tail;  // else the threshold is an order statistic of the sample
    std::optional<TiltedThreshold> tilted = {};  // or from weighted records
    std::vector<DetectionCell> cells;            // ascending size
    // What the healthy sample alone says of this threshold's false-alarm rate, whatever the
    // feature's distribution (false_alarm_rate.hpp, tail.hpp).
    Interval threshold_rate = {};
    // The same with the graded healthy gearboxes, and the expected rate over repeated studies that
    // they speak for, with the threshold's own scatter; NaN without graded healthy gearboxes and
    // beyond the sample. Where
    // healthy values tie with the threshold, only the upper end of the first holds, the second is
    // the graded ones' Clopper-Pearson interval and the third is NaN.
    double healthy_rate = 0.0;
    Interval healthy_rate_bounds = {};
    Interval expected_rate = {};
};

struct FeatureDetection {
    std::string feature;
    Alarm alarm = Alarm::high;
    std::vector<LevelDetection> levels;  // ascending noise
    std::vector<std::string> warnings;   // e.g. a threshold sample too small for the rate asked for
};

// What a fault size is and how it is shown: metres in mm, others as they are.
struct SizeUnit {
    std::string name = "fault_size";  // the parameter that holds a gearbox's fault size
    std::string unit = "m";           // of its values: "m", or "1" for a pure number

    std::string shown_unit() const { return unit == "m" ? "mm" : unit == "1" ? "" : unit; }
    double per_unit() const { return unit == "m" ? 1e-3 : 1.0; }  // shown = value / per_unit
};

struct DetectionRequest {
    double false_alarm_rate = 0.05;
    double confidence = 0.95;
    std::vector<double> noise_levels;
    std::vector<SizeGroup> groups;  // ascending; from levels or from edges
    SizeUnit size = {};
    // Inputs (columns of the gearboxes) whose distribution is what is known of one value that all
    // gearboxes have.
    std::vector<std::string> uncertain = {};
    // Rows of a gearbox that sets thresholds, one after another: records that differ in noise.
    std::size_t threshold_records = 1;
    bool threshold_tilt = false;  // those of the accelerometer's features are tilted
};

}  // namespace gearpod::analysis
