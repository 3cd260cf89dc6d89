// Detection rates as JSON, for other programs. Rates, bounds and thresholds that do not exist are
// null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "analysis/detection.hpp"

namespace gearpod::analysis {

// {"false_alarm_rate", "confidence", "size": {"name", "unit"}, "features": [{"name", "alarm",
//   "warnings": [...], "levels": [{"noise_level", "threshold", "threshold_sample",
//     "threshold_alarms", "reliable_size": [low, high] or null, "sizes": [{"size_low", "size_high",
//     "tested", "detected", "failed", "pd", "lower", "upper"}]}]}]}; sizes in their unit.
nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request);

}  // namespace gearpod::analysis
