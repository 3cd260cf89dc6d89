// Share of measured recordings beyond the thresholds, as a function of time. All recordings count,
// healthy, faulty or of unknown condition.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

struct TimeGroup {
    double first = 0.0, last = 0.0;  // first and last time
    long recordings = 0;
    std::vector<long> values;     // by feature: recordings that have it
    std::vector<long> alarms;     // by feature; -1: no threshold, or no values
    std::vector<double> medians;  // by feature; NaN: no values
};

// Groups recordings by time, ascending: one group for each time, or forty groups of about equal
// size. Empty without a column "time", or if the rows are not recordings.
std::vector<TimeGroup> alarms_over_time(const Results& frame, const RowSource& rows);

// Indices of the features in order of rank, or in file order without a ranking.
std::vector<std::size_t> ranked_features(const Results& frame,
                                         const std::optional<analysis::Reliability>& reliability);

// Table of the best ranked features, as many as fit into a line. Ends with a newline; "" without
// groups.
std::string alarms_text(const Results& frame, const std::vector<TimeGroup>& groups,
                        const std::optional<analysis::Reliability>& reliability);

// [{"first", "last", "recordings", "values": {feature: count}, "alarms": {feature: count or null},
// "medians": {feature: number or null}}]
nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups);

}  // namespace gearpod::mc
