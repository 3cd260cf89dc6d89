// A table of inspections' POD as a reader sees it in the terminal.
#pragma once

#include <string>

#include "analysis/report/inspection_json.hpp"

namespace gearpod::analysis {

// Sizes with POD 50 and 90 % with their bounds, by which rule, the curve, its parameters and what
// speaks against it, false calls, what other thresholds trade, and how many more specimens.
std::string inspection_text(const InspectionRequest& request, const InspectionResult& result,
                            const InspectionWords& words);

}  // namespace gearpod::analysis
