// The whole ensemble: every gearbox's features, in the order of the gearboxes whatever computed
// them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mc/ensemble/batch_crew.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/pd_watch.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/results_file.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Where an ensemble's batches come from and go to, and who may end it early.
struct EnsembleRun {
    const Ranks& ranks;
    RowStore& store;  // of rank 0: finished batches are not computed again
    Progress& progress;
    const Interruption* interruption = nullptr;
    PdWatch* watch = nullptr;    // ends the run once it knows enough; shown as it goes
    double checkpoint_s = 30.0;  // how often the store is synced
    std::function<void()> checkpointed = [] {};  // called after each sync
};

struct EnsembleOutcome {
    std::size_t batches = 0;       // the results are the first so many
    std::string interruption;      // "", or what ended the run before its time
    std::string failure;           // "", or what went wrong
    std::vector<CrewTimes> crews;  // by rank
    double wall_s = 0.0;
    double output_s = 0.0;  // rank 0's writing of batches
};

// Computes all batches that the store has not, on the threads of all ranks; every rank calls it.
// Rank 0 deals batches out in order as they are asked for and stores them. The outcome is rank 0's,
// in the others empty.
EnsembleOutcome run_batches(const Scene& scene, const BatchPlan& plan, const EnsembleRun& run);

// The same in memory and in this process, with all columns filled in. Detection and provenance are
// left to the caller.
Results run_ensemble(const Scene& scene, Progress& progress);

// What the results say besides their rows: names, units, noise levels, sizes. Columns are empty.
Results results_frame(const Study& study);

// Threads that the study asks for; for 0 the processors of this process, shared with the ranks
// beside it.
int thread_count(const Study& study, int ranks_on_this_machine = 1);

// The times of all threads together, for the results file.
std::vector<Timing> timing_of(const EnsembleOutcome& outcome);

// Detection of every feature from a results file's columns.
std::vector<analysis::FeatureDetection> detect_all(const Results& results);

}  // namespace gearpod::mc
