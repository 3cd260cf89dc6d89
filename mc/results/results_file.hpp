// Results file: HDF5, self-describing, with a format version.
//
//   /                      attributes: format, format_version and the provenance
//   /instances/<parameter> one value per row, attribute `unit`
//   /instances/group       0 threshold sample, 1 test gearbox, 2 recording of unknown state
//   /features/<feature>    rows x noise levels, attributes `unit` and `alarm`
//   /contact_loss/<mesh>   one value per row, attributes `unit` ("1") and `description`: the
//                          contact loss ratio. Absent if teeth cannot lose contact, and in files
//                          of versions before 0.3
//   /integration/superposed one value per row, attributes `unit` and `description`: 1 if the motion
//                          was superposed, 0 if all mesh periods were integrated. Absent unless
//                          numerics.horizon is "superposed"
//   /variants/<variant>/<feature>  as /features/<feature>, of the same gearboxes with other
//                          signals; attribute `description` of the variant
//   /noise_levels          factors on the sensor and encoder noise
//   /status                one value per row, attribute `meanings`
//   /detection             attributes false_alarm_rate, confidence, size_name (the parameter that
//                          holds a gearbox's fault size), size_unit; threshold_records if each
//                          gearbox of the threshold sample has several consecutive rows
//   /detection/<feature>/  size_low, size_high (sizes), noise_level, threshold, threshold_sample,
//                          threshold_alarms (levels), pd, lower, upper, detected, tested, failed
//                          (levels x sizes); attributes `alarm`, `warnings`
//   /numerical/<feature>/  after verification: rms, largest (levels), the changes of the feature in
//                          some gearboxes with finer steps; attributes of /numerical: setting,
//                          finer, gearboxes; after numerics.paired_gearboxes /numerical/pairs, as
//                          /assumptions
//   /step_error            if teeth lose contact and the run is long enough: attributes sensor,
//                          te, steps, finer_steps, gearboxes, meshes (StepError)
//   /assumptions           rows (of the results); for each changed assumption a dataset of these
//                          rows x features x noise levels, attributes `key` and `factor`
//   /timing/<name>         seconds, or a count (attribute `unit`)
//   /signals/<row>/<name>  one value per sample, attribute `unit`: signals of the requested rows
//
// The integrity hash stands in the user block (mc/results/file_checksum.hpp).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "machine/fields.hpp"
#include "mc/files/atomic_file.hpp"  // why_not_writable(path), to check before a long run
#include "mc/files/signal_file.hpp"
#include "mc/plan/ensemble_plan.hpp"

namespace gearpod::mc {

// To be increased when a reader of the current version would misread the file. Version 2 differs
// from 3 in the place of the integrity hash, and is read too.
inline constexpr int kResultsFormatVersion = 3, kOldestFormatVersion = 2;

// Result of the integration. diverged: the reason is unknown. supercritical, parametric,
// step_too_long: the reason is known, whether the solution diverged or did not converge
// (lockstep/steps/stability.hpp). no_equilibrium: quasi-static solution in which no tooth carries
// the load.
enum class Status {
    ok = 0,
    diverged = 1,
    not_converged = 2,
    supercritical = 3,
    parametric = 4,
    step_too_long = 5,
    no_equilibrium = 6
};
inline constexpr int kStatuses = 7;

// Third value of a row's group, in addition to those of Group: the row neither sets thresholds nor
// is a test gearbox.
inline constexpr int kNoGroup = 2;

// Value of the provenance's `kind` if the rows are measured recordings. Results of a run have no
// `kind`.
inline constexpr const char* kRecordingsKind = "recordings";

// Value of `kind` if the rows are lives. A feature then has one value per record instead of one per
// noise level, and the file has /hours (of the records) instead of /noise_levels. After the end of
// a life (/instances/records) the values are NaN. crack_depth, record_torque, record_speed,
// record_gain and record_noise are among the features. /instances/end_h is NaN if the tooth
// survives.
inline constexpr const char* kLivesKind = "lives";

struct ParameterResult {
    std::string name;
    std::string unit;
    std::vector<double> values;  // one per row
};

struct FeatureResult {
    std::string name;
    std::string unit;
    analysis::Alarm alarm = analysis::Alarm::high;
    std::vector<double> values;  // rows x noise levels, row-major; NaN: no value
};

// One number about the motion of every gearbox: the contact loss ratio of a mesh, or whether the
// motion was superposed.
struct RowColumn {
    std::string name;            // "sun-planet", "ring-planet", "pinion-gear" or "superposed"
    std::vector<double> values;  // one per row; NaN for a gearbox that failed
};

// Features of the same gearboxes with other signals.
struct Variant {
    std::string name, description;
    std::vector<FeatureResult> features;  // all of Results::features, in the same order
};

struct Timing {
    std::string name;
    double seconds = 0.0;
    const char* unit = "s";  // or "1" for a count
};

struct RowSignals {
    std::size_t row = 0;
    std::vector<SignalColumn> columns;
};

// Features of some rows with an assumption of the study at `factor` times its value.
struct ChangedAssumption {
    std::string key;
    double factor = 1.0;
    std::vector<double> values;  // rows x features x noise levels
};
inline constexpr const char* kFineSteps = "numerics.steps_per_mesh";
struct AssumptionRows {
    std::vector<std::int64_t> rows;  // of Results
    std::vector<ChangedAssumption> changed;
};

// Change of the features of some gearboxes when they are integrated with finer steps.
struct NumericalError {
    std::string setting, finer;  // solver settings of both integrations
    int gearboxes = 0;           // test gearboxes of which `rms` and `largest` are
    // [feature * noise levels + level], in the feature's unit.
    std::vector<double> rms, largest;
    AssumptionRows pairs = {};  // after numerics.paired_gearboxes: with fine steps (kFineSteps)
};

// Error due to the time step in signals of gearboxes whose teeth lose contact, estimated with finer
// steps.
struct StepError {
    double sensor = 0.0, te = 0.0;   // root mean square, relative
    int steps = 0, finer_steps = 0;  // per mesh period
    int gearboxes = 0, meshes = 0;   // size of the pilot run: gearboxes, and mesh periods of each
};
GEARPOD_FIELDS(StepError, sensor, te, steps, finer_steps, gearboxes, meshes)

// Results of an ensemble. A row is a gearbox, or in the threshold group a record of one. The
// threshold group comes first, then the test group.
struct Results {
    // Root attributes in order, e.g. {"git_hash", "..."}, {"study", resolved text}, {"seed", "1"}.
    // Writer and reader handle the format and format_version themselves.
    std::vector<std::pair<std::string, std::string>> provenance;
    std::vector<ParameterResult> parameters;
    std::vector<int> group;            // Group of each row
    std::vector<int> status;           // Status of each row
    std::vector<double> noise_levels;  // for lives: hours of the records
    std::vector<FeatureResult> features;
    std::vector<RowColumn> contact_loss;  // empty if teeth cannot lose contact
    std::vector<RowColumn> integration;   // "superposed" if numerics.horizon requests it
    std::vector<Variant> variants;
    analysis::DetectionRequest request;
    std::vector<analysis::FeatureDetection> detection;
    std::optional<NumericalError> numerical;
    std::optional<StepError> step_error;
    AssumptionRows assumptions;
    std::vector<Timing> timing;
    std::vector<RowSignals> signals;  // of chosen rows; not read back

    // Value of a provenance entry, "" if absent.
    std::string provenance_value(const std::string& name) const;
    std::optional<std::size_t> parameter_index(const std::string& name) const;
};

class RowSource;  // result_rows.hpp

// Writes a results file to F.h5.new in the same folder, flushes, syncs and renames it: the file at
// `path` is either the old or the complete new one. The rows come from `rows` and everything else
// from `frame`, whose columns are ignored. Memory does not grow with the number of rows. Throws
// std::runtime_error naming the path and the reason (not writable, disk full).
void write_results(const std::string& path, const Results& frame, const RowSource& rows);

// The same with the columns of `results`. Throws std::invalid_argument if their shapes disagree.
void write_results(const std::string& path, const Results& results);

// Reads a results file. Throws std::runtime_error naming the path and the reason: missing, not
// HDF5, not a gearpod results file, open for writing, damaged or truncated, or written by a newer
// version. A file without integrity hash is read with a note on stderr.
Results read_results(const std::string& path);

// The same without the columns; FileRows (mc/results/result_rows.hpp) reads the rows.
Results read_frame(const std::string& path);

// Reads a results file whatever its integrity hash. Throws as read_results() for all other reasons.
Results read_unverified_results(const std::string& path);

}  // namespace gearpod::mc
