// POD curves and areas under the ROC curve as JSON: the entries "hit_miss", "signal_response" and
// "auc" of reliability_json.hpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/statistics/auc.hpp"

namespace gearpod::analysis {

// Lists of sizes, POD and bounds.
nlohmann::json band_json(const std::vector<PodPoint>& band);
nlohmann::json hit_miss_json(const HitMissPod& pod);
nlohmann::json signal_response_json(const SignalResponsePod& pod);
nlohmann::json auc_json(const Auc& auc);

}  // namespace gearpod::analysis
