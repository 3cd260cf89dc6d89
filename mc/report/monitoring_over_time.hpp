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
#include "machine/fields.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// First alarm of a kind in one gearbox's recordings that are not known to be healthy.
struct FirstAlarm {
    std::size_t row = 0;
    double time = 0.0;
    // Recordings and time from the alarm to the gearbox's last recording.
    long recordings_left = 0;
    double time_left = 0.0;
};
GEARPOD_FIELDS(FirstAlarm, row, time, recordings_left, time_left)

// Worst tooth of a gearbox at its sustained alarm, in the baseline's numbering.
struct AlarmTooth {
    int tooth = 0;  // from 1
    // Number of the recordings that decide whether the alarm is sustained, and of those of them
    // whose worst tooth lies within one tooth of it.
    long recordings = 0, same = 0;
};
GEARPOD_FIELDS(AlarmTooth, number, recordings, same)

// Alarms of a detector in one gearbox's recordings that are not known to be healthy.
struct GearboxAlarms {
    std::string name;  // "": unknown
    long recordings = 0, alarms = 0;
    std::optional<FirstAlarm> first, sustained;
    std::optional<std::size_t> confirmed;  // row at which the sustained alarm is confirmed
    std::optional<AlarmTooth> tooth;       // known if the recordings are aligned
};
GEARPOD_FIELDS(GearboxAlarms, name, recordings, alarms, first_, sustained_, confirmed_, tooth)

struct RecordingMonitorResult {
    std::string feature;  // "fused": all features that the study uses, combined
    std::string detector;
    analysis::RecordThreshold threshold;
    double run_length = kNan;    // median recordings to the first alarm without a fault
    long healthy_sustained = 0;  // sustained alarms of healthy recordings
    analysis::HeldOutAlarms held_out;
    std::vector<GearboxAlarms> gearboxes;
};

// Recordings of one gearbox in time order, for figures.
struct GearboxSeries {
    std::string name;
    std::vector<std::size_t> rows;
    std::vector<double> time;
    std::vector<char> healthy;
    std::vector<double> alignment;  // of each recording; empty if unknown
    // RMS of every tooth, m/s^2, and position of the first one (ToothMap); empty if unknown
    std::vector<std::vector<double>> teeth;
    std::vector<double> first_tooth;
    // Deviations from the gearbox's own first recordings, by feature of MonitoringOverTime::shown.
    std::vector<std::vector<double>> deviations;
};
GEARPOD_FIELDS(GearboxSeries, name, rows, time, healthy_, alignment, tooth_rms, first_tooth,
               deviations_)

struct MonitoringOverTime {
    int baseline_records = 0;
    double false_alarm_rate = 0.0;  // per recording
    double confidence = 0.0;
    analysis::SustainedRule sustained;
    long healthy = 0;  // healthy recordings after the baselines
    bool torque_regression = false;
    std::vector<RecordingMonitorResult>
        watched;                     // each feature of the frame, then fused; by detector
    std::vector<std::string> shown;  // features that the study uses, and "fused"
    std::vector<GearboxSeries> gearboxes;
    std::vector<std::string> names;  // recording names, by row
    std::string time_unit;           // "": none
    std::string note;                // assumption made; else empty
    std::string refusal;             // why monitoring is impossible; else empty
};
GEARPOD_FIELDS(MonitoringOverTime, baseline_records, false_alarm_rate, confidence_, sustained,
               healthy_, torque_regression, watched_, shown_, gearboxes_, names_, time_unit, note,
               refusal_)

// Returns nothing unless the rows are recordings with times.
std::optional<MonitoringOverTime> monitoring_over_time(const Results& frame, const RowSource& rows);

// Sustained alarms by the features that the study uses, each with its first detector, and how often
// they alarmed falsely on recordings that did not set their threshold; at most six lines, sustained
// alarms first.
analysis::Section monitoring_answer(const MonitoringOverTime& monitoring);

// Section with a row for each gearbox and detector of the given features, of those that the study
// uses and of "fused", with statements on the healthy sample; or the reason why there is no
// monitoring.
analysis::Section monitoring_section(const MonitoringOverTime& monitoring,
                                     const std::vector<std::string>& features);

// docs/reference/report-json.md lists its keys.
nlohmann::json monitoring_json(const MonitoringOverTime& monitoring);

}  // namespace gearpod::mc
