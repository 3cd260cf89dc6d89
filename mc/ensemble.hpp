// The whole ensemble: every gearbox's features, in the order of the gearboxes whatever computed
// them.
#pragma once

#include "mc/progress.hpp"
#include "mc/results_file.hpp"
#include "mc/scene.hpp"

namespace gearpod::mc {

// Runs the threshold group and the graded group on the study's threads and fills parameters, group,
// status, features and timing. Detection and provenance are left to the caller.
Results run_ensemble(const Scene& scene, Progress& progress);

// Threads that the study asks for; all processors for 0.
int thread_count(const Study& study);

// Detection of every feature from a results file's columns.
std::vector<analysis::FeatureDetection> detect_all(const Results& results);

}  // namespace gearpod::mc
