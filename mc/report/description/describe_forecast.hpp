// Forecast of a run with many MPI ranks, from the forecast of one process.
#pragma once

#include "mc/numerics/forecast/forecast.hpp"
#include "mc/plan/planner.hpp"

namespace gearpod::mc {

// Processor time of rank 0's main thread for a batch of another rank: messages, packing and the
// checkpoint. Measured by tests/bench/bench_ranks (docs/developer/ensemble.md).
double leader_time_s(double batch_bytes);

// Disk space of the checkpoint with all batches, and of the results file.
double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape);
double results_bytes(const BatchPlan& plan, const RowShape& shape);

// Forecast for ranks that equal this process in machine, threads and memory.
struct RankForecast {
    double gearboxes_s = 0.0;       // wall-clock time to compute the gearboxes with all ranks
    double total_s = 0.0;           // including set-up and rank 0's analysis
    double busy_threads = 0.0;      // threads that have a batch to compute
    double rank_bytes = 0.0;        // memory of every rank except rank 0
    double leader_bytes = 0.0;      // memory of rank 0
    double checkpoint_bytes = 0.0;  // disk space during the run
    double results_bytes = 0.0;     // results file; twice while a new one is written
    double batches_per_s = 0.0;     // batches that rank 0 receives and writes
    double leader_share = 0.0;      // fraction of rank 0's time; at 1 it delays the others
    double bounding_ranks = 0.0;    // number of ranks from which rank 0 delays the others
};

RankForecast forecast_ranks(const RunCost& calibration, const BatchPlan& plan,
                            const RowShape& shape, const AnalysisTrial& analysis,
                            const RunForecast& alone, int ranks);

// Prints the forecast of a run's time and memory for `describe`.

// Computes some gearboxes and their analysis, for a few seconds at most. Prints the estimated time
// and memory of a run in this process, and in `ranks` such processes unless that is 0.
// `planner`: of the study of `scene`; `setup_s`: time used to start the program and build it.
void print_forecast(const Scene& scene, const Planner& planner, double setup_s, int ranks);

// Peak memory of this process.
struct PeakMemory {
    double setup_bytes = 0.0;     // when the scene was built
    double computed_bytes = 0.0;  // while gearboxes were computed; 0 if they took no more
};

// Forecast from the numbers of gearboxes and time steps alone, where computing some gearboxes takes
// too long.
void print_step_forecast(const TilePlan& tile, const EnsemblePlan& ensemble,
                         const PeakMemory& memory);

}  // namespace gearpod::mc
