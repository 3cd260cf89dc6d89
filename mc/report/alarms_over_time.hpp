// Share of measured recordings beyond the thresholds, as a function of time. All recordings count,
// healthy, faulty or of unknown condition.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/report/report.hpp"
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

// Section with a table of the three best of the features, which are in order of rank. Empty without
// groups.
analysis::Section alarms_section(const Results& frame, const std::vector<TimeGroup>& groups,
                                 const std::vector<std::size_t>& ranked);

// [{"first", "last", "recordings", "values": {feature: count}, "alarms": {feature: count or null},
// "medians": {feature: number or null}}]
nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups);

}  // namespace gearpod::mc
