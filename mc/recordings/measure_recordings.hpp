// Features of many recordings, and their output as a table and as a results file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mc/plan/ensemble_plan.hpp"
#include "mc/recordings/manifest.hpp"
#include "mc/recordings/measured_features.hpp"
#include "mc/recordings/recording_baselines.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Features of one recording.
struct MeasuredRecording {
    std::string problem;         // why there are no features, else empty
    std::vector<double> values;  // in the order of measurable(); NaN: no value
    std::vector<WorstTooth> teeth;
    std::vector<std::string> notes;  // of MeasuredSignal
    int sensor_meshes = 0, planet_turns = 0;
    double alignment = 0.0;  // correlation of the recording itself with its baseline; NaN: none
    int averaged = 1;        // number of recordings in the average, this one included
    ToothMap map;
};

struct MeasuredList {
    std::vector<MeasuredRecording> recordings;
    std::vector<std::string> notes;  // on the baselines
};

// Baselines with which recordings are compared.
struct RecordingComparison {
    const MeasuredBaseline* given = nullptr;  // an earlier recording that all share; may be null
    BaselineOptions options;

    // True if features that compare with a baseline are measured.
    bool any(const RecordingList& list) const { return given != nullptr || options.any(list); }
};

// Computes the features of all recordings. With options.average = m, those of the mean of the last
// m recordings of the gearbox (of fewer at its start), each aligned with the baseline; recordings
// that do not resemble it get a problem and are in no average. The transmission error is not
// averaged. The results do not depend on the number of threads. A recording that cannot be read
// gets a problem and does not stop the others. `done` is called after each recording, by one thread
// at a time.
MeasuredList measure_recordings(const RecordingList& list, const SignalColumns& columns,
                                const MeasurementPlan& plan, const HealthyReference& healthy,
                                const RecordingComparison& comparison, int threads,
                                const std::function<void()>& done);

// Prints the notes on the recordings to stderr, equal ones once with the first recording.
void print_notes(const RecordingList& list, const std::vector<MeasuredRecording>& measured);

// Problems with names of operating conditions that a results file cannot hold: names with a slash,
// and names that have a meaning there. `manifest` names the table.
Problems condition_name_problems(const std::string& manifest, const RecordingList& list);

// Returns a CSV table with a line for each recording: its description, its features (those of
// measurable()), with `compared` its alignment, the number of averaged recordings and the position
// of the worst tooth, and its problem.
std::string recordings_csv(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature* const> features, bool compared);

// Returns results in the format of a run, with a row for each recording that has features. Healthy
// recordings set the thresholds. Faulty recordings are evaluated by their size, or as size 1 if no
// recording has a size. Recordings of unknown condition are only stored. Features without any value
// are omitted. The provenance has the recording names, and with `compared` their alignments and
// tooth maps. `plan`: of the study that measured the recordings.
Results recordings_results(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature* const> features, bool compared,
                           const EnsemblePlan& plan, int threads);

}  // namespace gearpod::mc
