// Everything that a report says, as JSON: for other programs, and for the page (analysis/report).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "analysis/reliability.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// `frame.detection` must be up to date (detect_all). No reliability: the ensemble is too large.
// The keys are in mc/README.md. Two gearboxes are computed again for their signals
// (example_gearboxes.hpp).
nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability);

}  // namespace gearpod::mc
