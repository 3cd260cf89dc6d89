// Evidence pack of a report: a document (PDF), the tables (CSV), the JSON, the study and the hashes
// of these files. analysis/report/evidence arranges the findings.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/evidence/evidence.hpp"
#include "mc/report/tables.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// First line of the study in a pack; an output replaces only a file that begins with it.
inline constexpr const char* kEvidenceStudy = "# Study of an evidence pack, with all defaults\n";
inline constexpr const char* kEvidenceHashes = "# SHA-256 of the files of an evidence pack\n";

// Evidence of results: "sections" as in findings_json() and "study", the study's text. `file`:
// results file or table behind the findings. `frame`: its provenance and healthy alarms; null for a
// table of inspections.
nlohmann::json evidence_json(analysis::EvidenceKind kind, const analysis::Report& findings,
                             const std::vector<std::string>& indicators, const std::string& file,
                             const Results* frame);

// All files of the pack. `report`: JSON of a report with evidence_json() under "evidence". Throws
// as report_evidence() does.
std::vector<NamedFile> evidence_files(const nlohmann::json& report);

}  // namespace gearpod::mc
