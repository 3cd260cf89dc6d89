// HTML page, one-page PDF summary and evidence document of a report, made by the Python program in
// analysis/report.
#pragma once

#include <filesystem>
#include <string>

namespace gearpod::mc {

// Returns the HTML page for a report's JSON. GEARPOD_PYTHON names the interpreter (default
// /usr/bin/python3). GEARPOD_REPORT_DIR names the folder of the Python program; the default is the
// installed one. Throws std::runtime_error naming what is missing. The Python program prints its
// own errors to standard error.
//
// Also writes the figures as SVG and PNG into the folder `figures`, unless it is "".
std::string report_page(const std::string& json, const std::string& figures = "");

// Writes the page and its figures to the given places; "": none. Throws as report_page(), and if
// the page cannot be written.
void write_report_page(const std::string& json, const std::string& html,
                       const std::string& figures);

// Returns the path of the JSON schema of study files that belongs to this program, in the sources
// or installed; empty if there is none.
std::filesystem::path schema_path();

// Returns a one-page PDF: the result, its dependence on noise, its limits. `json` must come from
// report_json(). Throws like report_page().
std::string report_summary(const std::string& json);

// Returns the document of an evidence pack (PDF). `json` must have evidence_json() under
// "evidence". Throws like report_page().
std::string report_evidence(const std::string& json);

}  // namespace gearpod::mc
