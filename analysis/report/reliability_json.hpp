// POD curves, rankings and the dependence of detection on inputs and noise, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

// Dependence of detection on every random input and on the noise, as JSON.
//
// robustness: {"<input>": {"unit", "features": [{"name", "levels": [{"noise_level", "size_low",
//   "size_high" (fault sizes of the bins), "bins": [{"low", "high", "middle", "tested", "detected",
//   "pd", "lower", "upper"}], "statistic", "degrees", "p_value", "refusal"}]}]}}
// The entry "noise_level" has one "bins" per feature over all faulty gearboxes, one bin per noise
// level.
//
// a90_maps: {"<input>": {"unit", "noise_levels", "features": [{"name", "levels": [{"values",
//   "a90": [{"estimate", "lower", "upper"}], "refusal"}]}]}}
// The values are the input's 5, 25, 50, 75 and 95 % quantiles, or all of them if they are few.
// a90 has one entry per value; it is empty with a refusal.
//
// Sizes are in the request's unit; null where there is no number.
nlohmann::json robustness_json(const Reliability& reliability, const DetectionRequest& request);
nlohmann::json a90_maps_json(const Reliability& reliability, const DetectionRequest& request);

// POD curves, areas, ranking, misses and detection by condition as JSON. Missing numbers are null.
// A "refusal" gives the reason in words, null where there is a result.

// JSON form:
// {"size": {"name", "unit"}, "confidence",
//  "levels": [{"noise_level",
//    "smallest_fault": {"feature", "size", "from_curve",
//      "source": {"feature", "noise_level"} of the bound, or null: the feature itself} or null,
//    "ranking": {"healthy", "faulty", "refusal", "left_out",
//      "ranks": [{"name", "auc", "lower", "upper", "p_values"}]}}],
//  "features": [{"name", "alarm", "levels": [{"noise_level",
//    "hit_miss": {"tests", "hits", "smallest", "largest", "refusal", "doubtful", "supported",
//    "model", "link",
//      "log_size", "floor", "ceiling", "intercept", "slope", "aic", "fit", "a50", "a90",
//      "band": {"size", "pod", "lower", "upper"}, "candidates": [...]},
//    "signal_response": {...}, "auc": {...}, "auc_by_size": [...],
//    "roc": {"false_alarm_rate", "detection_rate"}, "misses": {...},
//    "by_false_alarm_rate": {"refusal", "points": [{"false_alarm_rate", "threshold",
//      "extrapolation": null for an order statistic, "tilted": true if from importance sampling,
//      "threshold_bounds": [lower, upper] (null: open), "a90"}],
//      "unfitted": [rates at which no curve fits]},
//    "least_cost": {"threshold", "extrapolation", "tilted", "false_alarm_rate", "rate_bounds",
//      "pd", "pd_bounds", "cost", "bounds", "without", "rarest"} or null,
//    "smallest_fault": as above}]}],
//  "conditions": [...], "robustness", "a90_maps"}
// Sizes are in their unit; a50 and a90 are {"estimate", "lower", "upper"}, each {"where", "size"},
// with one-sided bounds. Curves: POD = floor + (ceiling - floor) F(intercept + slope x), x the size
// or its natural logarithm.
// robustness, a90_maps: see there.
nlohmann::json reliability_json(const Reliability& reliability, const DetectionRequest& request);

// Smallest fault found by noise level, each as above or null. Without `reliability` it is from the
// tested rates alone.
nlohmann::json smallest_faults_json(std::span<const FeatureDetection> detection,
                                    const Reliability* reliability);

}  // namespace gearpod::analysis
