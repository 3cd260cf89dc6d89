// Detection rates as JSON, for other programs. Missing rates, bounds and thresholds are null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "analysis/detection/detection.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {

// JSON form:
// {"false_alarm_rate", "confidence", "size": {"name", "unit"},
//   "shortage": result of sample_shortage() or null,
//   "features": [{"name", "alarm", "warnings": [...], "levels": [{"noise_level", "threshold",
//     "threshold_sample", "threshold_alarms", "threshold_rate": [lower, upper], "tail": null where
//     the threshold is an order statistic, else {"extrapolation", "steady", "choices":
//     [{"exceedances", "above", "shape", "scale", "threshold", "rate"}]}, "tilted": null
//     unless it is from importance sampling, then {"gearboxes", "carrying", "extrapolation"},
//     "healthy_rate", "healthy_rate_bounds", "expected_rate", "reliable_size": [low, high] or null,
//     "sizes": [{"size_low", "size_high", "tested", "detected", "failed", "pd", "lower",
//     "upper", "exact": [lower, upper]}]}]}]}. Sizes are in their unit.
nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request,
                              Subject subject = Subject::gearboxes);

}  // namespace gearpod::analysis
