// POD curves, areas and ranking as a reader sees them in the terminal.
#pragma once

#include <string>

#include "analysis/reliability.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Per noise level: the smallest fault found, a row per feature in order of rank with AUC, a50, a90,
// a90 at the confidence, the curve and its fit, what cannot be told apart, and what decides the
// best feature's misses (robustness_text.hpp); then detection by condition. One line where fewer
// than ten healthy or ten faulty gearboxes have values. Of recordings without sizes AUC and ranking
// alone. At most text_width() columns. Ends with a newline.
std::string reliability_text(const Reliability& reliability, const DetectionRequest& request,
                             Subject subject = Subject::gearboxes);

}  // namespace gearpod::analysis
