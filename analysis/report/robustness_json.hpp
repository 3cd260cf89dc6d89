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
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

nlohmann::json robustness_json(const Reliability& reliability, const DetectionRequest& request);
nlohmann::json a90_maps_json(const Reliability& reliability, const DetectionRequest& request);

}  // namespace gearpod::analysis
