// Findings of a table of inspections as a report and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/inspection.hpp"
#include "analysis/report/report.hpp"

namespace gearpod::analysis {

// Names that the report uses.
struct InspectionNames {
    std::string table;                      // file of the table
    SizeUnit size;                          // name and unit of the size column
    std::string value;                      // name of the measured value
    std::string unit;                       // unit of responses; may be empty
    std::vector<std::string> remarks = {};  // statements on the table that come first
};

// The sizes with POD 50 and 90 % with their bounds and the rule of the bounds, the curve with its
// parameters and warnings, false calls, the trade-off over thresholds, and the number of further
// specimens needed. `result` has no refusal.
Report inspection_report(const InspectionRequest& request, const InspectionResult& result,
                         const InspectionNames& names);

// POD of a table of inspections; docs/reference/report-json.md lists the keys.
nlohmann::json inspection_json(const Inspections& data, const InspectionRequest& request,
                               const InspectionResult& result, const InspectionNames& words);

}  // namespace gearpod::analysis
