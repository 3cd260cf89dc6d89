// Complete report of a run as JSON, for other programs and for the page (analysis/report).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "mc/report/run_report.hpp"

namespace gearpod::mc {

// Returns the report; docs/reference/report-json.md lists the keys. The arguments are those of
// findings_of_run(), and its result. Computes two gearboxes again for their signals
// (example_gearboxes.hpp).
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability,
                           const RunFindings& run);
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability);

}  // namespace gearpod::mc
