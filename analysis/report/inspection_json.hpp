// POD of a table of inspections as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/inspection.hpp"

namespace gearpod::analysis {

// Names used in text and page.
struct InspectionNames {
    std::string table;  // file of the table
    SizeUnit size;      // name and unit of the size column
    std::string value;  // name of the measured value
    std::string unit;   // unit of responses; may be empty
};

// JSON form:
// {"kind": "inspection", "table", "size": {"name", "unit"}, "value": {"name", "unit"},
//  "confidence", "specimens", "repeats", "refusal",
//  "data": {"size", "value"},
//  "hit_miss": as in pod_json.hpp, with "location", "scale", "covariance" and "bound", or null,
//  "signal_response": the same, with "threshold", "censored", or null,
//  "false_calls": {"calls", "of", "lower", "upper", "laws": [{"law", "first", "second", "aic",
//    "at_threshold"}]},
//  "trade_off": [{"threshold", "false_calls", "a50", "a90"}],
//  "more_specimens": {"target", "factor", "more", "all_found"}}
nlohmann::json inspection_json(const Inspections& data, const InspectionRequest& request,
                               const InspectionResult& result, const InspectionNames& words);

}  // namespace gearpod::analysis
