// Inputs and outcome of an ensemble run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/ensemble/running_pd.hpp"
#include "mc/ensemble/worker_team.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {

// Source and destination of an ensemble's batches, and the conditions that may end the run early.
struct EnsembleRun {
    const Ranks& ranks;
    RowStore& store;  // rank 0 only; batches in it are not computed again
    Progress& progress;
    const Interruption* interruption = nullptr;
    RunningPd* watch = nullptr;  // ends the run at the required accuracy; shown as progress
    double checkpoint_s = 30.0;  // interval between two syncs of the store
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

}  // namespace gearpod::mc
