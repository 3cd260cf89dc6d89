// Sections of the report of a run, each with the values behind it.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/comparison/comparison.hpp"
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
    std::string name;  // "first", the name of an additional one, "mean of all", "largest of all",
                       // "learned sum of all"
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

}  // namespace gearpod::mc
