// A table of inspections' POD as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/inspection.hpp"

namespace gearpod::analysis {

// What the table is about, for text and page.
struct InspectionWords {
    std::string table;  // its file
    SizeUnit size;      // name and unit of the size's column
    std::string value;  // name of what was measured
    std::string unit;   // of responses; may be empty
};

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
                               const InspectionResult& result, const InspectionWords& words);

}  // namespace gearpod::analysis
