// What a run of many ranks takes, from what one process takes.
#pragma once

#include "mc/forecast/forecast.hpp"

namespace gearpod::mc {

// What rank 0's main thread takes of its processor for a batch of another rank: messages, packing
// and the checkpoint. tests/bench/bench_ranks, mc/README.md.
double leader_s(double batch_bytes);

// On the disk: of all batches while the run goes on, and of the results file.
double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape);
double results_bytes(const BatchPlan& plan, const RowShape& shape);

// Of ranks that are as this process: machine, threads, memory.
struct RankForecast {
    double gearboxes_s = 0.0;       // all ranks' together
    double total_s = 0.0;           // with set-up and rank 0's analysis
    double busy_threads = 0.0;      // that have a batch to compute
    double rank_bytes = 0.0;        // memory of every rank but
    double leader_bytes = 0.0;      // rank 0
    double checkpoint_bytes = 0.0;  // on the disk while it runs
    double results_bytes = 0.0;     // of the results file, twice while a new one is written
    double batches_per_s = 0.0;     // that rank 0 receives and writes
    double leader_share = 0.0;      // of its time: 1 where it holds the others up
    double bounding_ranks = 0.0;    // from so many on it does
};

RankForecast forecast_ranks(const Scene& scene, const BatchPlan& plan,
                            const RunCalibration& calibration, const AnalysisTrial& analysis,
                            const RunForecast& alone, int ranks);

}  // namespace gearpod::mc
