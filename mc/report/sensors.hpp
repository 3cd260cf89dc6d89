// Sensors of a run as detectors: each alone, and all together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// A sensor, or a value of all sensors, at the noise level where the best areas under the ROC of the
// sensors alone differ most. Only features of the acceleration count.
struct SensorDetection {
    double noise_level = 1.0;
    std::string name;  // "first", the name of an additional one, "mean of all", "largest of all",
                       // "learned sum of all"
    std::optional<analysis::SmallestFault> smallest;
    std::string feature;  // of the smallest fault, or else the best ranked one
    // Change from the first sensor with its own feature, in the same gearboxes; empty for the
    // first.
    std::optional<analysis::Comparison> change;
};

// Values of all sensors are the mean and the largest of their deviations from healthy gearboxes:
// differences from the median of the threshold sample over 1.4826 times its median absolute
// deviation, positive towards the alarm. Empty without additional sensors, without a fault size,
// or if there are too many values for curves.
std::vector<SensorDetection> sensor_detections(const Results& frame, const RowSource& rows);

analysis::Section sensors_section(const Results& frame,
                                  const std::vector<SensorDetection>& sensors);

}  // namespace gearpod::mc
