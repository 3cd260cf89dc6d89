// Report of a run, and its computing times for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/report/alarm_rates.hpp"
#include "mc/report/gearbox_values.hpp"
#include "mc/report/monitoring_over_time.hpp"
#include "mc/report/numerical_quality.hpp"
#include "mc/report/sensors.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Everything that a results file tells: the report, in the order of the page, and the numbers
// behind it.
struct RunFindings {
    std::optional<RunFacts> facts;  // empty if the study cannot be read
    Failures failures;
    std::vector<NumericalContribution> numerical;
    std::vector<OtherFaultAlarms> other_fault;
    std::vector<TimeGroup> over_time;
    std::optional<MonitoringOverTime> monitoring;
    std::vector<SensorDetection> sensors;
    std::vector<ContactLossSummary> contact_loss;
    analysis::Report report = {};
};

// `frame.detection` must be up to date (detect_all). `reliability` is empty if the ensemble is too
// large.
RunFindings findings_of_run(const Results& frame, const RowSource& rows,
                            const std::optional<analysis::Reliability>& reliability);

// Only the report.
inline analysis::Report results_report(const Results& frame, const RowSource& rows,
                                       const std::optional<analysis::Reliability>& reliability) {
    return findings_of_run(frame, rows, reliability).report;
}

// The answer for the end of a run: its sentence, the conditions for which it holds, and a warning
// of too few healthy gearboxes.
std::string headline_text(const analysis::Report& report);

// Prints the computing time by task, summed over all threads, with the least, mean and largest
// value of a rank.
void print_computing_times(const EnsembleOutcome& outcome);

// Complete report of a run as JSON, for other programs and for the page (analysis/report).

// Definition of a feature: {"name", "title", "unit", "alarm", "doc"}; title and doc are "" for a
// feature that is not the program's.
nlohmann::json definition_json(std::string_view name, std::string_view unit, analysis::Alarm alarm);

// Returns the report; docs/reference/report-json.md lists the keys. The arguments are those of
// findings_of_run(), and its result. Computes two gearboxes again for their signals
// (example_gearboxes.hpp).
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability,
                           const RunFindings& run);
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability);

}  // namespace gearpod::mc
