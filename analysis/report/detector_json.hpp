// The combined detector and the sensitivity of the misses at one noise level, as JSON.
//
// combined: {"weights": [{"feature", "weight"}], "intercept", "trained_healthy",
//   "trained_faulty", "detector", "single" (each {"name", "auc", "detection", "hit_miss"} on the
//   held-out gearboxes), "gain" (of the area), "p_value", "left_out", "warnings", "refusal"}
// sensitivity: {"feature", "size_low", "size_high", "misses", "values": each {"gearboxes",
//   "explained", "resolution", "terms", "inputs": [{"name", "unit", "first", "first_lower",
//   "first_upper", "total", "total_lower", "total_upper"}], "left_out", "refusal"}}; null without a
//   best feature
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/inputs/level_sensitivity.hpp"
#include "analysis/ranking/combined_detector.hpp"

namespace gearpod::analysis {

nlohmann::json combined_json(const CombinedDetector& combined);
nlohmann::json sensitivity_json(const LevelSensitivity& sensitivity);

}  // namespace gearpod::analysis
