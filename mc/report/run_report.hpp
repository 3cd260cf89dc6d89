// Report of a run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Everything that a results file tells: the report, in the order of the page, and the numbers
// behind it.
struct RunFindings {
    std::optional<RunFacts> facts;  // empty if the study cannot be read
    Failures failures;
    std::vector<NumericalContribution> numerical;
    std::vector<OtherFaultAlarms> other_fault;
    std::optional<MonitoringOverTime> monitoring;
    std::vector<SensorDetection> sensors;
    std::vector<ContactLossSummary> contact_loss;
    std::string best_feature = {};  // of the answer; "" without features
    analysis::Report report = {};
};

// `frame.detection` must be up to date (detect_all). `reliability` is empty if the ensemble is too
// large.
RunFindings findings_of_run(const Results& frame, const RowSource& rows,
                            const std::optional<analysis::Reliability>& reliability);

// Names of all sections that a report of a run can have, in their order.
inline const std::vector<std::string> kRunSections{
    "state",   "found",        "answer",  "limits",     "thresholds", "rates",    "pod",
    "ranking", "false_alarms", "inputs",  "conditions", "values",     "too_many", "monitoring",
    "sensors", "other_fault",  "contact", "numerical",  "failures",   "time"};

// Last lines of the screen: the file, and the commands for everything else.
std::vector<std::string> screen_end(const std::string& file, bool part);

// Complete report of a run as JSON, for other programs and for the page (analysis/report).

// Definition of a feature: {"name", "title", "unit", "alarm", "doc"}; title and doc are "" for a
// feature that is not the program's.
nlohmann::json definition_json(std::string_view name, std::string_view unit, analysis::Alarm alarm);

// Returns the report; docs/reference/report-json.md lists the keys. The arguments are those of
// findings_of_run(), and its result. Computes two gearboxes again for their signals
// (examples_json()).
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability,
                           const RunFindings& run);
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability);

}  // namespace gearpod::mc
