// Detection rates as JSON, for other programs. Missing rates, bounds and thresholds are null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/report/wording.hpp"
#include "analysis/statistics/rank_statistics.hpp"

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

// An entry of "levels" in detection_json().
nlohmann::json level_json(const LevelDetection& level);

// POD curves and areas under the ROC curve as JSON: the entries "hit_miss", "signal_response" and
// "auc" of reliability_json.hpp.

// Lists of sizes, POD and bounds.
nlohmann::json band_json(const std::vector<PodPoint>& band);
nlohmann::json hit_miss_json(const HitMissPod& pod);
nlohmann::json signal_response_json(const SignalResponsePod& pod);
nlohmann::json auc_json(const Auc& auc);

}  // namespace gearpod::analysis
