// Share of measured recordings beyond the thresholds, as a function of time. All recordings count,
// healthy, faulty or of unknown condition.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

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

// docs/reference/report-json.md lists the keys.
nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups);

// Alarms that another fault than the study's raises in healthy gearboxes
// (SourceRole::other_fault).

// Healthy gearboxes with the other fault that alarm, of one feature at one noise level. `without`
// counts the alarms of the same gearboxes without it, which set the threshold.
struct OtherFaultAlarms {
    std::size_t feature = 0, level = 0;
    long alarms = 0, tested = 0, without = 0;
    analysis::Interval interval;  // Wilson's, of the rate, at the confidence of the results
};
GEARPOD_FIELDS(OtherFaultAlarms, feature_, level_, alarms, tested, without, lower_upper)

// Alarms of every acceleration feature and noise level with a threshold; empty without another
// fault.
std::vector<OtherFaultAlarms> other_fault_alarms(const Results& frame, const RowSource& rows);

// Sentence on the alarms of one feature at one noise level; "" without them. `fault`: the other
// fault in words.
std::string other_fault_limit(const Results& frame, const std::string& fault,
                              const std::vector<OtherFaultAlarms>& alarms,
                              const std::string& feature, std::size_t level);
analysis::Section other_fault_section(const Results& frame, const std::string& fault,
                                      const std::vector<OtherFaultAlarms>& alarms);

}  // namespace gearpod::mc
