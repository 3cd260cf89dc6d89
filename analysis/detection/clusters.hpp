// Detection from healthy samples of two levels: several recordings of each of fewer gearboxes
// (clustered_rate.hpp).
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

// detect() of healthy rows whose gearboxes are given; as many of them as rows, or of tilted
// records: the same as without.
FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& graded,
                                  const DetectionRequest& request);

}  // namespace gearpod::analysis
