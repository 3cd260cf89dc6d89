// Detection with a threshold of its own for every operating condition (a torque level, say), beside
// the one for all conditions: a feature that follows the torque hides faults behind it. Park (2017)
// finds the RMS of transmission error to grow with the torque.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

struct ConditionThreshold {
    double condition = 0.0;  // value of the input that sets it
    double threshold = 0.0;  // NaN if the condition has too few healthy gearboxes
    long sample = 0;
    long alarms = 0;
    Interval rate;  // of its false alarms, as LevelDetection::threshold_rate
};

struct ConditionLevel {
    double noise_level = 0.0;
    std::vector<ConditionThreshold> thresholds;  // ascending condition
    std::vector<DetectionCell> cells;  // every gearbox against its own condition's threshold
    long without = 0;  // graded gearboxes whose condition has no threshold; in no cell
};

struct ConditionDetection {
    std::string feature;
    std::string input;  // its column's name
    std::string unit;
    Alarm alarm = Alarm::high;
    std::vector<ConditionLevel> levels;
    std::vector<std::string> warnings;
    std::string refusal;  // why there is none, else empty
};

struct ConditionColumn {
    std::string name;
    std::string unit;
    std::span<const double> healthy;  // value a gearbox
    std::span<const double> graded;
    std::span<const std::size_t> gearbox = {};  // of `healthy`; empty: each its own
};

// Refused if the input has more than 50 values: conditions are levels, not a continuous input.
ConditionDetection detect_by_condition(const std::string& feature, Alarm alarm,
                                       const FeatureSample& healthy, const FeatureSample& graded,
                                       const ConditionColumn& column,
                                       const DetectionRequest& request);

}  // namespace gearpod::analysis
