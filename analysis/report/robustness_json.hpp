// Detection against every random input and against the noise, as JSON.
//
// robustness: {"<input>": {"unit", "features": [{"name", "levels": [{"noise_level", "size_low",
//   "size_high" (fault sizes of the bins), "bins": [{"low", "high", "middle", "tested", "detected",
//   "pd", "lower", "upper"}], "statistic", "degrees", "p_value", "refusal"}]}]}}
// and "noise_level", whose features have one "bins" over all faulty gearboxes, a bin a noise level.
//
// a90_maps: {"<input>": {"unit", "noise_levels", "features": [{"name", "levels": [{"values": of the
//   input, "a90": [{"estimate", "lower", "upper"}], one a value, "refusal"}]}]}}
// where the values are the input's 5, 25, 50, 75 and 95 % quantiles, or all of them if they are
// few; a90 is empty with a refusal.
//
// Sizes in the request's unit; null where there is no number.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

nlohmann::json robustness_json(const Reliability& reliability, const DetectionRequest& request);
nlohmann::json a90_maps_json(const Reliability& reliability, const DetectionRequest& request);

}  // namespace gearpod::analysis
