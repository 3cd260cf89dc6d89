// The HTML page of a report, and its summary on one sheet, made by the Python program in
// analysis/report.
#pragma once

#include <string>

namespace gearpod::mc {

// The page for a report's JSON. Python is GEARPOD_PYTHON, by default /usr/bin/python3; the
// program's folder is GEARPOD_REPORT_DIR, by default the one that this program was built from.
// Throws std::runtime_error with what is missing; what the Python program itself finds wrong it
// says on standard error.
//
// Into the folder `figures`, unless it is "", go its figures too, each as SVG and PNG.
std::string report_page(const std::string& json, const std::string& figures = "");

// PDF of one sheet: the answer, how it depends on noise, what limits it. Only of report_json().
// Throws as report_page() does.
std::string report_summary(const std::string& json);

}  // namespace gearpod::mc
