// Detection from two-level healthy samples: several recordings of each of fewer gearboxes
// (clustered_rate.hpp).
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

// Calls detect() and widens the intervals for healthy rows grouped by gearbox. With one row per
// gearbox, or with importance-sampled records, the result is that of detect().
FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& graded,
                                  const DetectionRequest& request);

}  // namespace gearpod::analysis
