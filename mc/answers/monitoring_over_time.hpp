// Measured recordings of gearboxes in time order, watched as a monitor would: each gearbox against
// its own first recordings, by every detector of the study (analysis/monitoring), with thresholds
// from the recordings known to be healthy.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// What a detector says of one gearbox's recordings that are not known to be healthy.
struct WatchedGearbox {
    std::string name;  // "" if it is not known
    long recordings = 0, alarms = 0;
    std::optional<std::size_t> first;  // of the alarms: row
    double first_time = 0.0;
};

struct WatchedFeature {
    std::string feature;  // "fused": all that the study uses
    std::string detector;
    // Of a rate per 1000 recordings: `hours` counts recordings.
    analysis::MonitorThreshold threshold;
    std::vector<WatchedGearbox> gearboxes;
};

struct MonitoringOverTime {
    int baseline_records = 0;
    double false_alarm_rate = 0.0;  // of a recording
    bool torque_regression = false;
    std::vector<WatchedFeature> watched;  // the frame's features, then fused; by detector
    std::vector<std::string> names;       // of the recordings, by row
    std::string time_unit;                // "" without
    std::string note;                     // what is taken for granted; else empty
    std::string refusal;                  // why nothing is watched; else empty
};

// None unless the rows are recordings with times.
std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame, const RowSource& rows);

// A line for each detector of the features named, "fused" always. Ends with a newline.
std::string monitoring_text(const MonitoringOverTime& monitoring,
                            const std::vector<std::string>& features);

// {"baseline_records", "false_alarm_rate", "torque_regression", "note", "refusal", "watched":
// [{"feature", "detector", "threshold", "healthy": {"recordings", "alarms"}, "gearboxes": [{"name",
// "recordings", "alarms", "first": {"row", "time", "recording"} or null}]}]}
nlohmann::json monitoring_json(const MonitoringOverTime& monitoring);

}  // namespace gearpod::mc
