// Evidence on condition indicators, arranged by the subjects of EASA AMC1 29.1465 (vibration health
// monitoring, CS-29 Amendment 12, 2024) and MIL-HDBK-1823A (2009; probability of detection). It
// words no result anew: each statement and table of the report stands under one subject, and each
// subject states what the results do not provide.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/report/report.hpp"

namespace gearpod::analysis {

// Kind of results. lives: simulated gearboxes whose faults grow. inspections: a table of sizes and
// outcomes.
enum class EvidenceKind { gearboxes, recordings, lives, inspections };

struct EvidenceSource {
    EvidenceKind kind = EvidenceKind::gearboxes;
    const Report& findings;
    std::vector<std::string> indicators;  // names of the features
    // Blocks in addition to those of the report, each with the key of its section.
    std::vector<std::pair<std::string, std::variant<Statement, Table>>> added = {};
    bool has_hashes = true;  // of the measured files
};

// Sections: scope, definition, threshold, false_alarms, detection, limits, data, software, further.
// Each block of the findings is in exactly one of them, except statements that repeat another one.
// Keys of added blocks begin with "evidence.".
Report evidence_report(const EvidenceSource& source);

// Alarms of healthy rows: those that set the threshold, and the test gearboxes of size 0, with the
// Clopper-Pearson interval of the latter. Without healthy test rows a dash.
Table healthy_alarms_table(const std::vector<FeatureDetection>& detection,
                           const DetectionRequest& request, const std::string& rows);

}  // namespace gearpod::analysis
