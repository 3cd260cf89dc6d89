// Alarms that another fault than the study's raises in healthy gearboxes
// (SourceRole::other_fault).
#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

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
