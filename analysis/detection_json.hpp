// Detection rates as JSON, for other programs. Rates, bounds and thresholds that do not exist are
// null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "analysis/detection.hpp"

namespace gearpod::analysis {

// {"false_alarm_rate", "confidence", "features": [{"name", "alarm", "warnings": [...],
//   "levels": [{"noise_level", "threshold", "threshold_sample", "threshold_alarms",
//     "reliable_size_m": [low, high] or null, "sizes": [{"size_low_m", "size_high_m", "tested",
//     "detected", "failed", "pd", "lower", "upper"}]}]}]}; lengths in metres.
nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request);

}  // namespace gearpod::analysis
