// Documents of a report, made by the Python program in analysis/report: page (HTML), summary (PDF),
// tables (CSV), evidence pack and dataset.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

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

// File of a folder.
struct NamedFile {
    std::string name;
    std::string bytes;
};

// Tables of a report with all digits (CSV). Column names contain units; a missing number is an
// empty field. Throws like report_page().
std::vector<NamedFile> table_files(const nlohmann::json& report);

// Dataset for machine learning: features with labels, stored signals (CSV) and a data card.
// `report` has dataset_json() under "dataset". Throws like report_page().
std::vector<NamedFile> dataset_files(const nlohmann::json& report);

// Evidence pack of a report: document (PDF), tables, JSON, study, and the hashes of these files.
// `file`: results or table of inspections behind it. Throws like report_page().
std::vector<NamedFile> evidence_files(nlohmann::json report, const std::string& file);

}  // namespace gearpod::mc
