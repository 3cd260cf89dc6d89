// Outcome of every gearbox (detected, missed or without a value), and the POD curve of the
// outcomes.
#pragma once

#include <span>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"

namespace gearpod::analysis {

// 1 detected, 0 missed, -1 no value.
std::vector<int> outcomes(std::span<const double> values, double threshold, Alarm alarm);

// Fits the POD curve; refuses without a threshold. The floor is the healthy rate of the detection.
HitMissPod pod_of_outcomes(std::span<const double> sizes, const std::vector<int>& hit,
                           const LevelDetection& detection, double confidence,
                           int band_points = HitMissRequest{}.band_points);

}  // namespace gearpod::analysis
