// Sets of records of healthy gearboxes, measured or simulated.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/files/input/problems.hpp"
#include "signals/tile_signals.hpp"

namespace gearpod::mc {

// Length of each record in mesh periods: [gearbox][record].
using RecordLengths = std::vector<std::vector<int>>;

// [gearbox][record][feature], in the order of the set's features.
using RecordValues = std::vector<std::vector<std::vector<double>>>;
using UsedFeatures = std::vector<const features::Feature*>;

// Records with which a study is calibrated: their gearbox, length and features.

struct HealthyRecord {
    std::string gearbox;  // "": a separate gearbox
    int meshes = 0;
    std::vector<double> values;  // in the order of features::record_features(); NaN if missing
};

// Adds problems with the columns of such a table: none is a sensor feature, or a requested one is
// missing. Throws SignalError if the table cannot be read.
void check_feature_table(const std::string& path, const std::vector<std::string>& requested,
                         Problems& problems);

// Reads a table as written by `features --csv` (text_table.hpp), one record per line. Columns are
// named after features. Optional columns: gearbox, label (faulty lines are skipped), planet_turns
// (default: the span's) and problem (lines with a problem are skipped). Problems name the line.
// Throws SignalError if the table cannot be read.
std::vector<HealthyRecord> read_feature_table(const std::string& path,
                                              const signals::SpanLayout& span, Problems& problems);

// Largest number of gearboxes, and of records of each, that are simulated. From more, evenly spaced
// ones are selected.
inline constexpr std::size_t kMostGearboxes = 16, kMostRecords = 8;

struct HealthySet {
    RecordLengths lengths;
    RecordValues values;  // in the order of `features`
    UsedFeatures features;
    std::size_t records = 0, left_out = 0;  // number selected, and number not selected

    // Mean over the selected records; 0 without the feature.
    double mean_of(const std::string& feature) const;
};

// Selects records and features. `requested` holds names of features. If it is empty, all sensor
// features are used that all records have, that need no healthy reference, and that do not refer to
// the teeth of the sun or the ring. Missing features are added to the problems.
HealthySet healthy_set(const std::vector<HealthyRecord>& records,
                       const std::vector<std::string>& requested, Problems& problems);

}  // namespace gearpod::mc
