// Sections of the report of a run or of recordings, each with the values behind it: one source file
// for each family of sections.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/monitoring/false_alarms.hpp"
#include "analysis/reliability.hpp"
#include "analysis/report/findings/findings.hpp"
#include "analysis/report/report.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Number of gearboxes by status. `diverged` counts every failure except those that did not converge
// to the periodic steady state.
struct RowCounts {
    std::size_t all = 0, diverged = 0, not_converged = 0;
    std::array<std::size_t, kStatuses> with_status{};

    std::size_t failed() const { return diverged + not_converged; }
};

// Counts gearboxes. `records`: rows of each threshold gearbox
// (DetectionRequest::threshold_records); only the first one counts.
RowCounts count_rows(const RowSource& rows, std::size_t records);

// Failed gearboxes of a run by reason, and features without a value.
struct Failures {
    RowCounts counts;
    std::vector<std::pair<std::size_t, int>> first;  // at most 20: row, status
    std::vector<std::vector<long>> no_value;         // by feature and noise level, without failures
};

Failures failures_of(const Results& frame, const RowSource& rows);

// Failed gearboxes with their reasons; on the screen if there are any.
analysis::Section failures_section(const Results& frame, const Failures& failures);

// docs/reference/report-json.md lists the keys.
nlohmann::json failures_json(const Results& frame, const Failures& failures);

// The error of the time steps where teeth lose contact, and the numerical error next to the
// statistical one; each only if it was estimated.
analysis::Section numerical_section(const Results& frame,
                                    const std::vector<NumericalContribution>& contributions);

// Both errors of a feature's detection rate at a noise level; "" if they are not known.
std::string numerical_limit(const std::vector<NumericalContribution>& contributions,
                            const std::string& feature, double noise_level);

// Contact loss ratio of one mesh, over the gearboxes that did not fail.
struct ContactLossSummary {
    std::string mesh;
    double mean = 0.0;
    double lower = 0.0, median = 0.0, upper = 0.0;  // quantiles 0.05, 0.5 and 0.95
    std::size_t rows = 0;
};
GEARPOD_FIELDS(ContactLossSummary, mesh, mean, lower, median, upper, gearboxes)

// One entry for each mesh that has a value in some row; none where teeth cannot separate.
std::vector<ContactLossSummary> summarise_contact_loss(const Results& frame, const RowSource& rows);

// Lists means and the central 90 % range over the gearboxes, for example
// "sun-planet 4.2 % (1.1 % to 9.3 %), ring-planet ...". "" without meshes.
std::string contact_loss_text(const std::vector<ContactLossSummary>& meshes);

// Section of a report; empty without meshes.
analysis::Section contact_section(const std::vector<ContactLossSummary>& meshes);

// Table of feature values for each gearbox. It replaces the detection rates if a study has too few
// healthy gearboxes for any threshold, such as the studies of published figures. It has the values
// of the test rows at every noise level, with the inputs that differ between the rows. Empty if a
// feature has a threshold, or if there are more than 60 rows. `frame.detection` must be up to date
// (detect_all).
analysis::Section feature_values(const Results& frame, const RowSource& rows);

// Healthy gearboxes with another fault than the study's (SourceRole::other_fault) that alarm, of
// one feature at one noise level. `without` counts the alarms of the same gearboxes without it,
// which set the threshold.
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

// Limits of an answer: detection at half and at twice each assumption of its study. "" and no rows
// where the results have no rows with changed assumptions (AssumptionRows).
struct AssumptionLimits {
    std::string strongest;   // sentence on the assumption that changes the answer most
    bool decides = false;    // it changes a size, or the share that is found, by more than 10 %
    std::string fine_steps;  // the same on the steps of the integration
    analysis::Table table;   // all assumptions
};
// The limits concern the best feature at the noise level of the answer, or at the next lower one at
// which a fault is found.
AssumptionLimits assumption_limits(const Results& frame, const RowSource& rows,
                                   const analysis::Findings& findings);

// A sensor, or a value of all sensors, at the noise level where the best areas under the ROC of the
// sensors alone differ most. Only features of the acceleration count.
struct SensorDetection {
    double noise_level = 1.0;
    std::string name;  // "first", the name of an additional one, "mean of all", "largest of all"
    std::optional<analysis::SmallestFault> smallest;
    std::string feature;  // of the smallest fault, or else the best ranked one
    // Change from the first sensor with its own feature, in the same gearboxes; empty for the
    // first.
    std::optional<analysis::Comparison> change;
};

// Values of all sensors are the mean and the largest of their deviations from healthy gearboxes:
// differences from the median of the threshold sample over 1.4826 times its median absolute
// deviation, positive towards the alarm. Empty without additional sensors, without a fault size,
// or if there are too many values for curves.
std::vector<SensorDetection> sensor_detections(const Results& frame, const RowSource& rows);

analysis::Section sensors_section(const Results& frame,
                                  const std::vector<SensorDetection>& sensors);

// Two example gearboxes, one healthy and one with the largest fault, computed again to show the
// signals from which features are computed, and the mesh stiffness. Returns {"examples":
// {"refusal", "noise_level", "gearboxes": [...]}, "stiffness": {"refusal",
// ...}} for the study stored in the file (docs/reference/report-json.md lists the keys). The
// gearboxes are the first rows with values of size 0 and of the largest size. `refusal` is the
// reason why there are none, or null. Signals and spectra are thinned for plotting.
nlohmann::json examples_json(const Results& frame, const RowSource& rows);

// Monitoring of measured recordings in time order. Every detector of the study compares each
// gearbox with its own first recordings (analysis/monitoring). The thresholds come from the
// recordings known to be healthy.

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
