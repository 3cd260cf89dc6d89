// What a run of an ensemble is given, and what it comes to.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mc/ensemble/batch_crew.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/pd_watch.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/batch_rows.hpp"

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

    // Of all ranks.
    int threads() const {
        int all = 0;
        for (const CrewTimes& crew : crews) {
            all += crew.threads;
        }
        return all;
    }
    Seconds work() const {
        Seconds all;
        for (const CrewTimes& crew : crews) {
            all += crew.work;
        }
        return all;
    }
};

}  // namespace gearpod::mc
