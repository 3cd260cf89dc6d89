// The records that a study is calibrated by: of which gearbox, how long, with what features.
#pragma once

#include <string>
#include <vector>

#include "mc/calibration/record_sets.hpp"
#include "mc/input/problems.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

struct HealthyRecord {
    std::string gearbox;  // "": one of its own
    int meshes = 0;
    std::vector<double> values;  // by features::record_features(); NaN: none
};

// A table as `features --csv` writes it (text_table.hpp), a line a record: columns named after
// features, and, if there are, gearbox, label (faulty lines are left out), planet_turns (default:
// the span's) and problem (lines that have one are left out). Problems name the line. Throws
// SignalError if the table itself cannot be read.
std::vector<HealthyRecord> read_feature_table(const std::string& path, const Scene& scene,
                                              Problems& problems);

// At most so many gearboxes, and records of each, are simulated; of more, evenly chosen ones.
inline constexpr std::size_t kMostGearboxes = 16, kMostRecords = 8;

struct HealthySet {
    RecordLengths lengths;
    RecordValues values;  // by `features`
    std::vector<const features::Feature*> features;
    std::size_t records = 0, left_out = 0;  // taken, and not for want of room

    // Of the records taken; 0 without the feature.
    double mean_of(const std::string& feature) const;
};

// `wanted`: features by name; without any, those of the sensor that all records have and that need
// neither other healthy records nor the sun's or the ring's teeth. Problems name what a record has
// not.
HealthySet healthy_set(const std::vector<HealthyRecord>& records,
                       const std::vector<std::string>& wanted, Problems& problems);

}  // namespace gearpod::mc
