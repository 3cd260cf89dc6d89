// Computes the whole ensemble: the features of every gearbox, in the order of the gearboxes.
#pragma once

#include <functional>
#include <vector>

#include "mc/ensemble/ensemble_run.hpp"
#include "mc/results/results_file.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Computes all batches that the store does not have, on the threads of all ranks. Every rank must
// call it. Rank 0 assigns the batches in order and stores them. The outcome is empty in the other
// ranks.
EnsembleOutcome run_batches(const Scene& scene, const BatchPlan& plan, const EnsembleRun& run);

// The same for any kind of batch. `make` is called once in every rank, before the first batch.
EnsembleOutcome run_batches(const Study& study, const BatchPlan& plan, const EnsembleRun& run,
                            const std::function<BatchComputers()>& make);

// Computes all results in memory and in this process. Detection and provenance are not filled in.
Results run_ensemble(const Scene& scene, Progress& progress);

// Results without rows: names, units, noise levels and sizes.
Results results_frame(const Study& study);

// Times summed over all threads, for the results file.
std::vector<Timing> timing_of(const EnsembleOutcome& outcome);

// Detection results of every feature, from the columns of a results file.
std::vector<analysis::FeatureDetection> detect_all(const Results& results);

}  // namespace gearpod::mc
