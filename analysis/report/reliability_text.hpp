// POD curves, areas and ranking for the terminal.
#pragma once

#include <string>

#include "analysis/reliability.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Per noise level: the smallest fault found, a row per feature in order of rank with AUC, a50, a90,
// the bound of a90, the curve and its fit, the features that do not differ significantly, and the
// inputs that influence the best feature's misses (robustness_text.hpp); then detection by
// condition. One line if fewer than ten healthy or ten faulty gearboxes have values. Recordings
// without sizes have AUC and ranking only. At most text_width() columns. Ends with a newline.
std::string reliability_text(const Reliability& reliability, const DetectionRequest& request,
                             Subject subject = Subject::gearboxes);

}  // namespace gearpod::analysis
