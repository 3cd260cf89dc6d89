// The results file: HDF5, self-describing, versioned.
//
//   /                      attributes: format, format_version and the provenance
//   /instances/<parameter> one value a gearbox, attribute `unit`
//   /instances/group       0 threshold sample, 1 graded, 2 neither (recordings of unknown state)
//   /features/<feature>    gearboxes x noise levels, attributes `unit` and `alarm`
//   /contact_loss/<mesh>   one value a gearbox, attributes `unit` ("1") and `description`: the
//   share
//                          of time out of contact; absent where teeth cannot part, and from files
//                          of versions before 0.3
//   /noise_levels          factors on the sensor and encoder noise
//   /status                one value a gearbox, attribute `meanings`
//   /detection             attributes false_alarm_rate, confidence, size_name (the parameter that
//                          holds a gearbox's fault size), size_unit; threshold_records where a
//                          gearbox of the threshold sample has several rows, one after another
//   /detection/<feature>/  size_low, size_high (sizes), noise_level, threshold, threshold_sample,
//                          threshold_alarms (levels), pd, lower, upper, detected, tested, failed
//                          (levels x sizes); attributes `alarm`, `warnings`
//   /numerical/<feature>/  if it was verified: rms, largest (levels), what finer steps change in
//                          some gearboxes; attributes of /numerical: rung, finer, gearboxes
//   /step_error            where teeth lose contact and the run is long enough: attributes sensor,
//                          te, steps, finer_steps, gearboxes, meshes (StepError)
//   /timing/<name>         seconds
//   /signals/<row>/<name>  one value a sample, attribute `unit`: of the gearboxes asked for
//
// A checksum follows the HDF5 part (mc/results/seal.hpp); other programs do not see it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "mc/files/atomic_file.hpp"  // why_not_writable(path), to ask before a long run

namespace gearpod::mc {

// Raised when a reader of the current version would misread the file.
inline constexpr int kResultsFormatVersion = 2;

// diverged: for no reason that is known. supercritical, parametric, step_too_long: for a known one,
// whether it diverged or just did not settle (lockstep/steps/instability.hpp). no_equilibrium:
// without inertia, and no tooth carries the load.
enum class Status {
    ok = 0,
    diverged = 1,
    not_settled = 2,
    supercritical = 3,
    parametric = 4,
    step_too_long = 5,
    no_equilibrium = 6
};
inline constexpr int kStatuses = 7;

// Beside the groups of random numbers (Group): a row that neither sets thresholds nor is graded.
inline constexpr int kUngraded = 2;

// The provenance's `kind` where the rows are measured recordings; a run's results have none.
inline constexpr const char* kRecordingsKind = "recordings";

// The same where the rows are lives: then a feature has one value a record in place of one a noise
// level, and the file the records' /hours in place of /noise_levels. A feature's values end with
// the life (/instances/records), NaN behind it; crack_depth, record_torque, record_speed,
// record_gain and record_noise stand among the features. /instances/end_h is NaN of a tooth that
// holds.
inline constexpr const char* kLivesKind = "lives";

// The parameter that holds the weights of tilted records (signals/windowing/noise_tilt.hpp).
inline constexpr const char* kNoiseWeight = "noise_weight";

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

// The contact loss ratio of one mesh.
struct MeshResult {
    std::string name;            // "sun-planet", "ring-planet" or "pinion-gear"
    std::vector<double> values;  // one per row; NaN of a gearbox that failed
};

struct Timing {
    std::string name;
    double seconds = 0.0;
    const char* unit = "s";  // or "1" of a count
};

// One value a sample.
struct SignalColumn {
    std::string name;
    std::string unit;
    std::vector<double> values;
};

// The signals of one gearbox.
struct RowSignals {
    std::size_t row = 0;
    std::vector<SignalColumn> columns;
};

// What marching some gearboxes again, by finer steps, changes in their features.
struct NumericalError {
    std::string rung, finer;  // how they were marched
    int gearboxes = 0;
    // By feature and noise level, [feature * noise levels + level], in the feature's unit.
    std::vector<double> rms, largest;
};

// Error that the run's time steps leave in signals where teeth lose contact, found by finer steps.
struct StepError {
    double sensor = 0.0, te = 0.0;   // root mean square, relative
    int steps = 0, finer_steps = 0;  // a mesh period
    int gearboxes = 0, meshes = 0;   // of the pilot: gearboxes, and mesh periods of each
};

// A row is a gearbox, or in the threshold group a record of one: that group in order of instance,
// then the graded group.
struct Results {
    // Root attributes in order, e.g. {"git_hash", "..."}, {"study", resolved text}, {"seed", "1"}.
    // The file's format and format_version are written and checked by this module.
    std::vector<std::pair<std::string, std::string>> provenance;
    std::vector<ParameterResult> parameters;
    std::vector<int> group;            // Group per row
    std::vector<int> status;           // Status per row
    std::vector<double> noise_levels;  // of lives: hours of the records
    std::vector<FeatureResult> features;
    std::vector<MeshResult> contact_loss;  // empty where teeth cannot part
    analysis::DetectionRequest request;
    std::vector<analysis::FeatureDetection> detection;
    std::optional<NumericalError> numerical;
    std::optional<StepError> step_error;
    std::vector<Timing> timing;
    std::vector<RowSignals> signals;  // of chosen gearboxes; not read back

    // The value of a provenance entry, "" if absent.
    std::string provenance_value(const std::string& name) const;
};

class RowSource;  // row_source.hpp

// Writes to F.h5.new in the same folder, flushes, fsyncs and renames: the file at `path` is either
// the old or the complete new one. Takes the rows from `rows` and everything else from `frame`,
// whose columns are not looked at; memory does not grow with the rows. Throws std::runtime_error
// naming the path and the reason (not writable, disk full).
void write_results(const std::string& path, const Results& frame, const RowSource& rows);

// The same with the columns in `results`. Throws std::invalid_argument if their shapes disagree.
void write_results(const std::string& path, const Results& results);

// Throws std::runtime_error naming the path and the reason: missing, not HDF5, not a gearpod
// results file, damaged or truncated, written by a newer version.
Results read_results(const std::string& path);

// The same without the columns, whose rows FileRows (mc/results/file_rows.hpp) reads.
Results read_frame(const std::string& path);

}  // namespace gearpod::mc
