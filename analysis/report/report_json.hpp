// Serialises a report's findings as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/report/report.hpp"

namespace gearpod::analysis {

// JSON form:
// [{"key", "title", "blocks": [{"key", "text"} or {"key", "title", "columns", "rows"}]}]
nlohmann::json findings_json(const Report& report);

}  // namespace gearpod::analysis
