// Grades values that a user computed for the gearboxes of a run, as `run` grades its features.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::mc {

struct OwnValues {
    std::string name;  // for messages and in the result
    std::string unit;
    analysis::Alarm alarm = analysis::Alarm::high;
    double noise_level = 1.0;    // of the values; only shown
    std::vector<double> values;  // one per row of the results; NaN: no value
};

// Detection rates, POD curves and areas under the ROC curve, with the groups, sizes, false-alarm
// rate and confidence of a results file:
// {"detection": {"false_alarm_rate", "confidence", "size", "level": as in detection_json.hpp},
//  "reliability": an entry of "levels" of a feature in detection_json.hpp, or null for too many
//  gearboxes}
// Throws BadInput if the number of values is not that of the rows, if the threshold records are
// importance-sampled, or for a file of lives; std::runtime_error if the file cannot be read.
nlohmann::json grade_values(const std::string& path, const OwnValues& given);

}  // namespace gearpod::mc
