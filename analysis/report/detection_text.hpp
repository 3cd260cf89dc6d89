// Detection table for the terminal.
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Per noise level: the thresholds with their samples and the intervals of their false-alarm rates,
// then a row per fault size with `Pd [lower, upper]` of every feature. Tables are at most
// text_width() columns wide; further features follow in further blocks. Ends with the smallest
// tested size at and above which the lower bound of Pd is at least 0.9, the warnings, and a
// newline. Recordings have no noise level, and no size where faults have only a label.
std::string detection_text(std::span<const FeatureDetection> features,
                           const DetectionRequest& request, Subject subject = Subject::gearboxes);

}  // namespace gearpod::analysis
