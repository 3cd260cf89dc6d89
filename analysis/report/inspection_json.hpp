// POD of a table of inspections as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/report/inspection_report.hpp"

namespace gearpod::analysis {

// JSON form:
// {"kind": "inspection", "table", "size": {"name", "unit"}, "value": {"name", "unit"},
//  "confidence", "convention", "specimens", "repeats", "refusal",
//  "data": {"size", "value"},
//  "hit_miss": as in pod_json.hpp, with "location", "scale", "covariance", "bound",
//    "simulated_coverage", "clusters" and "design_effect", or null,
//  "signal_response": the same without clusters, with "threshold", "censored" and
//    "growing_scatter": {"answered", "coverage"}, or null,
//  "false_calls": {"calls", "of", "lower", "upper", "laws": [{"law", "first", "second", "aic",
//    "at_threshold"}]},
//  "trade_off": [{"threshold", "false_calls", "a50", "a90"}],
//  "more_specimens": {"target", "factor", "more", "all_found"},
//  "findings": findings_json() of inspection_report()}
nlohmann::json inspection_json(const Inspections& data, const InspectionRequest& request,
                               const InspectionResult& result, const InspectionNames& words);

}  // namespace gearpod::analysis
