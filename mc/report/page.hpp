// Documents of a report, made by the Python program in analysis/report: page (HTML), summary (PDF),
// tables (CSV) and evidence pack.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace gearpod::mc {

// Makes the HTML page for a report's JSON and writes it, and its figures as SVG, PNG and PDF, to
// the given file and folder; "": none. GEARPOD_PYTHON names the interpreter (default
// /usr/bin/python3). GEARPOD_REPORT_DIR names the folder of the Python program; the default is the
// installed one. Throws std::runtime_error naming what is missing, or if the page cannot be
// written. The Python program prints its own errors to standard error.
void write_report_page(const std::string& json, const std::string& html,
                       const std::string& figures);

// Returns the path of the JSON schema of study files that belongs to this program, in the sources
// or installed; empty if there is none.
std::filesystem::path schema_path();

// Returns a one-page PDF: the result, its dependence on noise, its limits. `json` must come from
// report_json(). Throws like write_report_page().
std::string report_summary(const std::string& json);

// File of a folder.
struct NamedFile {
    std::string name;
    std::string bytes;
};

// Files of a folder. `kind`: "--csv" for all tables with all digits; column names contain units,
// and a missing number is an empty field. Throws like write_report_page().
std::vector<NamedFile> report_files(const nlohmann::json& report, const std::string& kind);

// Evidence pack of a report: document (PDF), tables, JSON, study, and the hashes of these files.
// `file`: results or table of inspections behind it. Throws like write_report_page().
std::vector<NamedFile> evidence_files(nlohmann::json report, const std::string& file);

}  // namespace gearpod::mc
