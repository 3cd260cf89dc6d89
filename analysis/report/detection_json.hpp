// Detection rates, POD curves, rankings and the dependence of detection on inputs and noise as
// JSON, for other programs; docs/reference/report-json.md lists the keys. Missing numbers are null.
// Sizes are in the request's unit.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "analysis/reliability.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {

nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request,
                              Subject subject = Subject::gearboxes);

// POD curves, areas, ranking, misses, detection by condition, and its dependence on every random
// input and on the noise.
nlohmann::json reliability_json(const Reliability& reliability, const DetectionRequest& request);

// Smallest fault found by noise level, each an object or null. Without `reliability` it is from the
// tested rates alone.
nlohmann::json smallest_faults_json(std::span<const FeatureDetection> detection,
                                    const Reliability* reliability);

}  // namespace gearpod::analysis
