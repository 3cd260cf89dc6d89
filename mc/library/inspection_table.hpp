// Probability of detection (POD) from a table of inspections.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/report/inspection_report.hpp"
#include "mc/files/text/text_table.hpp"

namespace gearpod::mc {

struct InspectionOptions {
    std::string size;                 // size column; "": found by its usual names
    std::vector<std::string> hits;    // hit/miss columns; several are repeated inspections
    std::vector<std::string> values;  // response columns
    std::string specimen;
    std::vector<std::string> links;  // empty: all
    std::string size_scale;          // "linear", "log"; "": both
    std::string response_scale;      // "linear", "log", "box-cox" or a power; "": linear and log
    // "": calibrated bounds, or the handbook's if `bounds` names a method.
    std::string convention, bounds;
    std::string alarm = "high";
    std::optional<double> threshold, false_call_rate, left, right, floor, target;
    double confidence = 0.95;
    bool fit_ceiling = false, firth = false;
};

struct InspectedTable {
    analysis::Inspections data;
    analysis::InspectionRequest request;
    analysis::InspectionResult result;
    analysis::InspectionNames names;
};

// Throws BadInput (mc/files/input/problems.hpp) with all problems of the table and the options, or
// with the reason why there is no result.
InspectedTable inspect_table(const TextTable& table, const InspectionOptions& options);

// Text and JSON of the program for the same.
std::string inspection_text(const InspectedTable& inspected);
nlohmann::json inspection_json(const InspectedTable& inspected);

}  // namespace gearpod::mc
