#include "mc/report/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/sha256.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/report/page.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {
namespace {

using analysis::EvidenceKind;

std::string study_of_evidence(const Results& frame) {
    const std::string study = frame.provenance_value("study");
    return study.empty() ? frame.provenance_value("measured_by_study") : study;
}

// Measured files with their hashes and numbers of recordings.
analysis::Table recorded_files_table(const Results& frame) {
    analysis::Table table{
        "evidence.recordings", "Measured files", {"file", "recordings", "SHA-256"}, {}};
    std::map<std::string, long> counts;
    std::istringstream names(frame.provenance_value("recordings"));
    for (std::string name; std::getline(names, name);) {
        counts[name.substr(0, name.rfind(" row "))]++;
    }
    std::istringstream files(frame.provenance_value(kRecordedFiles));
    for (std::string line; std::getline(files, line);) {
        const std::size_t gap = line.find("  ");
        const std::string file = gap == std::string::npos ? line : line.substr(gap + 2);
        table.rows.push_back({printable(file), std::to_string(counts[file]), line.substr(0, gap)});
    }
    return table;
}

// Study, and the kind of damage that its indicators monitor; "" if it cannot be read.
std::string monitored_text(EvidenceKind kind, const std::string& text) {
    const auto titled = [](const std::string& title) {
        return fmt::format("Study: {}.", title.empty() ? "without a title" : title);
    };
    if (kind == EvidenceKind::recordings) {
        const auto facts = measuring_facts(text);
        return facts ? titled(facts->title) : "";
    }
    const auto facts = run_facts(text);
    return !facts ? ""
                  : titled(facts->ensemble.title) +
                        (facts->fault.given()
                             ? fmt::format(" Damage that is monitored: {}.", facts->fault.words)
                             : "");
}

// How the results are computed again.
std::string repeat_text(EvidenceKind kind) {
    const auto simulated = [](const char* command) {
        return fmt::format(
            "The file study.toml of this folder is the study with all defaults; it follows this "
            "table. The same version repeats the results bit for bit with `gearpod {} study.toml`, "
            "for any number of threads, ranks and lanes.",
            command);
    };
    switch (kind) {
        case EvidenceKind::gearboxes:
            return simulated("run");
        case EvidenceKind::lives:
            return simulated("lives");
        case EvidenceKind::recordings:
            return "The file study.toml of this folder states how the recordings were evaluated; "
                   "it follows this table.";
        case EvidenceKind::inspections:
            break;
    }
    return "";
}

analysis::Table software_table(const Results* frame) {
    analysis::Table table{"evidence.software", "", {"entry", "value"}, {}};
    if (frame != nullptr) {
        for (const char* name :
             {"code_version", "git_hash", "compiler", "instruction_set", "kernels", "seed", "ranks",
              "threads", "lanes", "host", "date", "state", "gearboxes_asked_for"}) {
            if (const std::string value = frame->provenance_value(name); !value.empty()) {
                std::string words = name;
                std::replace(words.begin(), words.end(), '_', ' ');
                table.rows.push_back({words, printable(value)});
            }
        }
    }
    table.rows.push_back({"report by", version_text()});
    return table;
}

}  // namespace

nlohmann::json evidence_json(EvidenceKind kind, const analysis::Report& findings,
                             const std::vector<std::string>& indicators, const std::string& file,
                             const Results* frame) {
    analysis::EvidenceSource source{kind, findings, indicators};
    const std::string hash = file_sha256(file);
    source.added.emplace_back(
        "data",
        analysis::Table{"evidence.file",
                        kind == EvidenceKind::inspections ? "Table of inspections" : "Results file",
                        {"file", "SHA-256"},
                        {{printable(file), hash.empty() ? "cannot be read" : hash}}});
    std::string study;
    if (frame != nullptr) {
        study = study_of_evidence(*frame);
        if (const std::string monitored = monitored_text(kind, study); !monitored.empty()) {
            source.added.emplace_back("definition",
                                      analysis::Statement{"evidence.monitored", monitored});
        }
        if (analysis::Table healthy =
                healthy_alarms_table(frame->detection, frame->request,
                                     kind == EvidenceKind::recordings ? "recordings" : "gearboxes");
            !healthy.rows.empty()) {
            source.added.emplace_back("false_alarms", std::move(healthy));
        }
        if (kind == EvidenceKind::recordings) {
            analysis::Table files = recorded_files_table(*frame);
            source.has_hashes = !files.rows.empty();
            if (source.has_hashes) {
                source.added.emplace_back("data", std::move(files));
            }
        }
    }
    if (const std::string repeat = repeat_text(kind); !repeat.empty()) {
        source.added.emplace_back("software", analysis::Statement{"evidence.repeat", repeat});
    }
    source.added.emplace_back("software", software_table(frame));
    return {{"sections", findings_json(evidence_report(source))},
            {"study", study.empty() ? nlohmann::json(nullptr) : nlohmann::json(study)}};
}

std::vector<NamedFile> evidence_files(const nlohmann::json& report) {
    std::vector<NamedFile> files{{"evidence.pdf", report_evidence(json_text(report))},
                                 {"report.json", json_text(report, 2) + "\n"}};
    if (const auto& study = report["evidence"]["study"]; study.is_string()) {
        files.push_back({"study.toml", kEvidenceStudy + study.get<std::string>()});
    }
    for (NamedFile& table : table_files(report_tables(report))) {
        files.push_back(std::move(table));
    }
    std::string hashes = kEvidenceHashes;
    for (const NamedFile& one : files) {
        hashes += fmt::format("{}  {}\n", sha256(one.bytes), one.name);
    }
    files.push_back({"SHA256SUMS", hashes});
    return files;
}

}  // namespace gearpod::mc
