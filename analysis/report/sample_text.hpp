// Whether a healthy sample is large enough for the false-alarm rate asked of it, in words: said
// before a run and as a report's first line.
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection_table.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Of `healthy` that set thresholds: that there is none, or that their false-alarm rate may be more
// than twice the one asked for, and how many it takes; "" where they suffice. One sentence or two.
std::string sample_shortage(long healthy, double false_alarm_rate, double confidence,
                            Subject subject);

// The same of the smallest sample among a report's thresholds, which names the noise levels that
// have none at all.
std::string sample_shortage(std::span<const FeatureDetection> features,
                            const DetectionRequest& request, Subject subject);

// No feature has a threshold at the noise level: nothing is known of the faults there.
bool without_threshold(std::span<const FeatureDetection> features, std::size_t level);

}  // namespace gearpod::analysis
