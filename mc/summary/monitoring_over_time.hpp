// Monitoring of measured recordings in time order. Every detector of the study compares each
// gearbox with its own first recordings (analysis/monitoring). The thresholds come from the
// recordings known to be healthy.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/monitoring/false_alarms.hpp"
#include "analysis/report/report.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Alarms of a detector in one gearbox's recordings that are not known to be healthy.
struct GearboxAlarms {
    std::string name;  // "": unknown
    long recordings = 0, alarms = 0;
    std::optional<std::size_t> first;  // row of the first alarm
    double first_time = 0.0;
};

struct RecordingMonitorResult {
    std::string feature;  // "fused": all features that the study uses, combined
    std::string detector;
    // Here the rate is per 1000 recordings, and `hours` counts recordings.
    analysis::MonitorThreshold threshold;
    std::vector<GearboxAlarms> gearboxes;
};

struct MonitoringOverTime {
    int baseline_records = 0;
    double false_alarm_rate = 0.0;  // per recording
    bool torque_regression = false;
    std::vector<RecordingMonitorResult>
        watched;                     // each feature of the frame, then fused; by detector
    std::vector<std::string> names;  // recording names, by row
    std::string time_unit;           // "": none
    std::string note;                // assumption made; else empty
    std::string refusal;             // why monitoring is impossible; else empty
};

// Returns nothing unless the rows are recordings with times.
std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame, const RowSource& rows);

// Section with a row for each gearbox and detector of the given features and of "fused", or the
// reason why there is no monitoring.
analysis::Section monitoring_section(const MonitoringOverTime& monitoring,
                                     const std::vector<std::string>& features);

// {"baseline_records", "false_alarm_rate", "torque_regression", "note", "refusal", "watched":
// [{"feature", "detector", "threshold", "healthy": {"recordings", "alarms"}, "gearboxes": [{"name",
// "recordings", "alarms", "first": {"row", "time", "recording"} or null}]}]}
nlohmann::json monitoring_json(const MonitoringOverTime& monitoring);

}  // namespace gearpod::mc
