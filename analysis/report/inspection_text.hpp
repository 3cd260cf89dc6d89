// POD of a table of inspections for the terminal.
#pragma once

#include <string>

#include "analysis/report/inspection_json.hpp"

namespace gearpod::analysis {

// Report text: sizes with POD 50 and 90 % with their bounds and the rule of the bounds, the curve
// with its parameters and warnings, false calls, the trade-off over thresholds, and the number of
// further specimens needed.
std::string inspection_text(const InspectionRequest& request, const InspectionResult& result,
                            const InspectionNames& words);

}  // namespace gearpod::analysis
