// Detection with a separate threshold for every operating condition (a torque level, for example),
// in addition to the common one. A feature that follows the torque hides faults in its variation.
// Park (2017) finds that the RMS of transmission error grows with the torque.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct ConditionThreshold {
    double condition = 0.0;  // value of the input that defines the condition
    double threshold = 0.0;  // NaN if the condition has too few healthy gearboxes
    long sample = 0;
    long alarms = 0;
    Interval rate;  // false-alarm rate, as LevelDetection::threshold_rate
};
GEARPOD_FIELDS(ConditionThreshold, condition, threshold, sample, alarms, rate_lower_upper)

struct ConditionLevel {
    double noise_level = 0.0;
    std::vector<ConditionThreshold> thresholds;  // by ascending condition
    std::vector<DetectionCell> cells;  // every gearbox against the threshold of its condition
    long without = 0;  // test gearboxes whose condition has no threshold; they are in no cell
};
GEARPOD_FIELDS(ConditionLevel, noise_level, thresholds, sizes, without_threshold)

struct ConditionDetection {
    std::string feature;
    std::string input;  // column name
    std::string unit;
    Alarm alarm = Alarm::high;
    std::vector<ConditionLevel> levels;
    std::vector<std::string> warnings;
    std::string refusal;  // reason why there is no result, or ""
};
GEARPOD_FIELDS(ConditionDetection, feature, input, unit, alarm_, levels, warnings, refusal)

struct ConditionColumn {
    std::string name;
    std::string unit;
    std::span<const double> healthy;  // one value per gearbox
    std::span<const double> test;
    // Index of the gearbox of each value of `healthy`; empty if every value has its own gearbox.
    std::span<const std::size_t> gearbox = {};
};

// Refuses an input with more than 50 different values, because conditions must be levels, and one
// that is not known of a healthy gearbox. Throws std::invalid_argument unless there is one
// condition per gearbox.
ConditionDetection detect_by_condition(const std::string& feature, Alarm alarm,
                                       const FeatureSample& healthy, const FeatureSample& test,
                                       const ConditionColumn& column,
                                       const DetectionRequest& request);

}  // namespace gearpod::analysis
