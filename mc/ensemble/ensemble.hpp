// The whole ensemble: every gearbox's features, in the order of the gearboxes whatever computed
// them.
#pragma once

#include <functional>
#include <vector>

#include "mc/ensemble/ensemble_run.hpp"
#include "mc/results/results_file.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Computes all batches that the store has not, on the threads of all ranks; every rank calls it.
// Rank 0 deals batches out in order as they are asked for and stores them. The outcome is rank 0's,
// in the others empty.
EnsembleOutcome run_batches(const Scene& scene, const BatchPlan& plan, const EnsembleRun& run);

// The same of whatever makes up the study's batches. `make` is called once in every rank, before
// the first batch.
EnsembleOutcome run_batches(const Study& study, const BatchPlan& plan, const EnsembleRun& run,
                            const std::function<BatchComputers()>& make);

// The same in memory and in this process, with all columns filled in. Detection and provenance are
// left to the caller.
Results run_ensemble(const Scene& scene, Progress& progress);

// What the results say besides their rows: names, units, noise levels, sizes. Columns are empty.
Results results_frame(const Study& study);

// The times of all threads together, for the results file.
std::vector<Timing> timing_of(const EnsembleOutcome& outcome);

// Detection of every feature from a results file's columns.
std::vector<analysis::FeatureDetection> detect_all(const Results& results);

}  // namespace gearpod::mc
