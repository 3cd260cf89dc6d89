// Options of `features`, for one recording and for many.
#pragma once

#include <string>
#include <vector>

#include "mc/library/run/run_options.hpp"
#include "mc/recordings/recording_baselines.hpp"

namespace gearpod::mc {

struct FeaturesOptions {
    StudyOptions study;
    std::vector<std::string> signals;  // files, or glob patterns
    std::string manifest;              // table of recordings, instead of signals
    SignalColumns columns;
    std::vector<std::string> healthy;  // recordings of healthy gearboxes
    std::string baseline;              // earlier recording of the same gearbox, "": none
    // Baselines of many recordings; average 0: monitoring.average_records.
    BaselineOptions baselines{0, {}, false, 0};
    double noise_level = 1.0;  // of simulated healthy gearboxes, used without `healthy`
    std::string json;          // "": none; "-": standard output
    std::string out, csv;      // results file and table, for many recordings
    std::string against;       // results file of healthy gearboxes to compare with
    std::string feature;       // decides the alarm; "": the best ranked one in `against`
    bool force = false;        // replaces outputs of another kind
    bool quiet = false;
};

// Writes the features of many recordings to a results file and a table. Returns the exit code.
int recordings_command(const FeaturesOptions& options);

}  // namespace gearpod::mc
