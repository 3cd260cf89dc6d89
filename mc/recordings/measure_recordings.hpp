// The features of many recordings, and what becomes of them: a table and a results file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mc/gearbox/measured_features.hpp"
#include "mc/recordings/manifest.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Of one recording.
struct MeasuredRecording {
    std::string problem;         // why it has none, else empty
    std::vector<double> values;  // by measurable(); NaN: none
    std::vector<WorstTooth> teeth;
    int sensor_meshes = 0, planet_turns = 0;
};

// `baseline`, if there is one, is of the gearbox that all are of. By as many threads; the same
// numbers whatever they are. A recording that cannot be read has a problem and stops nothing.
// `done` is called after each, by one thread at a time.
std::vector<MeasuredRecording> measure_recordings(const RecordingList& list,
                                                  const SignalColumns& columns, const Scene& scene,
                                                  const HealthyReference& healthy,
                                                  const MeasuredBaseline* baseline, int threads,
                                                  const std::function<void()>& done);

// A line each, with what is known of it, its features (those that were measurable()) and its
// problem.
std::string recordings_csv(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature> features);

// As a run's: a row for each recording that has features. Healthy ones set the thresholds, faulty
// ones are graded, by their size or, where no size is known, as size 1; the others only stand in
// the file. Features that no recording has are left out. Names are in the provenance.
Results recordings_results(const RecordingList& list,
                           const std::vector<MeasuredRecording>& measured,
                           std::span<const features::Feature> features, const Scene& scene,
                           int threads);

}  // namespace gearpod::mc
