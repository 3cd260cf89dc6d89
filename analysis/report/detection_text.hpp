// The detection table that a reader sees in the terminal.
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Per noise level: thresholds with the sample that set them and how well it fixes their rate, then
// a row per fault size with `Pd [lower, upper]` of every feature; at most text_width() columns
// wide, features beyond that in further blocks. Closes with the smallest tested size from which on
// the lower bound of Pd stays at least 0.9, and the warnings. Recordings have no noise level to
// name, and no size where faults only have a label. Ends with a newline.
std::string detection_text(std::span<const FeatureDetection> features,
                           const DetectionRequest& request, Subject subject = Subject::gearboxes);

}  // namespace gearpod::analysis
