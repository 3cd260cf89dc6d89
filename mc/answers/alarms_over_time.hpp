// When measured recordings raise the alarm: the share of those of each time that lie beyond the
// thresholds, of all recordings, whatever is known of them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/reliability.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

struct TimeGroup {
    double first = 0.0, last = 0.0;  // times
    long recordings = 0;
    std::vector<long> values;     // by feature: recordings that have it
    std::vector<long> alarms;     // by feature; -1: no threshold, or no values
    std::vector<double> medians;  // by feature; NaN: no values
};

// Ascending: one a time, or forty of about as many recordings. Empty without a column time, or if
// the rows are no recordings.
std::vector<TimeGroup> alarms_over_time(const Results& frame, const RowSource& rows);

// Places of the features in order of rank, if there is one, else as they are.
std::vector<std::size_t> ranked_features(const Results& frame,
                                         const std::optional<analysis::Reliability>& reliability);

// Of the best ranked features, as many as fit into a line. Ends with a newline; "" without groups.
std::string alarms_text(const Results& frame, const std::vector<TimeGroup>& groups,
                        const std::optional<analysis::Reliability>& reliability);

// [{"first", "last", "recordings", "values": {feature: count}, "alarms": {feature: count or null},
// "medians": {feature: number or null}}]
nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups);

}  // namespace gearpod::mc
