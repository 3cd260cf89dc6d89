// Inputs and outcome of an ensemble run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Source and destination of an ensemble's batches, and the conditions that may end the run early.
struct EnsembleRun {
    const Ranks& ranks;
    RowStore& store;  // rank 0 only; batches in it are not computed again
    Progress& progress;
    const Interruption* interruption = nullptr;
    double checkpoint_s = 30.0;                  // interval between two syncs of the store
    std::function<void()> checkpointed = [] {};  // called after each sync
};

struct EnsembleOutcome {
    std::size_t batches = 0;       // number of leading batches that form the results
    std::string interruption;      // reason for an early end, or ""
    std::string failure;           // error message, or ""
    std::vector<TeamTimes> teams;  // indexed by rank
    double wall_s = 0.0;
    double output_s = 0.0;  // time of rank 0 for writing batches

    // Sums over all ranks.
    int threads() const {
        int all = 0;
        for (const TeamTimes& team : teams) {
            all += team.threads;
        }
        return all;
    }
    Seconds work() const {
        Seconds all;
        for (const TeamTimes& team : teams) {
            all += team.work;
        }
        return all;
    }
};

// Distributes the batches of a run over its ranks. Rank 0 assigns batches in order, a few to every
// rank. A rank that has finished a batch sends its rows and gets another, so a slow rank does not
// delay the others. Only the main thread of a rank communicates; it sleeps between polls.

// Computes all batches that the store does not have, on the threads of all ranks. Every rank must
// call it. Rank 0 assigns the batches in order and stores them. The outcome is empty in the other
// ranks.
EnsembleOutcome run_batches(const TilePlan& tile, const EnsemblePlan& ensemble,
                            const BatchPlan& plan, const EnsembleRun& run);

// The same for any kind of batch. `make` is called once in every rank, before the first batch.
EnsembleOutcome run_batches(const EnsemblePlan& ensemble, const BatchPlan& plan,
                            const EnsembleRun& run, const std::function<BatchComputers()>& make);

// Computes all results in memory and in this process. Detection and provenance are not filled in.
Results run_ensemble(const TilePlan& tile, const EnsemblePlan& ensemble, Progress& progress);

// Times summed over all threads, for the results file.
std::vector<Timing> timing_of(const EnsembleOutcome& outcome);

// Detection results of every feature, from the columns of a results file.
std::vector<analysis::FeatureDetection> detect_all(const Results& results);

}  // namespace gearpod::mc
