// Complete report of a run as JSON, for other programs and for the page (analysis/report).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "analysis/reliability.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Returns the report; docs/reference/report-json.md lists the keys. `frame.detection` must be up to
// date (detect_all). `reliability` is empty if the ensemble is too large. Computes two gearboxes
// again for their signals (example_gearboxes.hpp).
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability);

}  // namespace gearpod::mc
