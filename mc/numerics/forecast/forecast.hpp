// Estimates the time and memory of a run from a few computed gearboxes, and those of the analysis
// of its results from the number of values.
#pragma once

#include <array>
#include <vector>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/gearbox/integration_cache.hpp"
#include "mc/plan/planner.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Measures the cost of a run on some of its gearboxes, with the code of the run itself.

// Seconds of one thread for a tile: as many gearboxes as there are lanes, computed together.
struct TileCost {
    Seconds whole;      // per tile, full or not: sampling, stiffness, time integration, signals
    Seconds row;        // per record: noise, features
    double rest = 0.0;  // per tile: diagnosis of failed gearboxes, waiting for a processor

    double seconds(std::size_t rows) const {
        return whole.sum() + rest + static_cast<double>(rows) * row.sum();
    }
};

// Cost of the gearboxes of one group.
struct GroupCost {
    TileCost integrated;  // integrated
    TileCost reused;      // with the motion of an earlier tile (integration_cache.hpp)
};

// Process memory in bytes.
struct MemoryUse {
    double before = 0.0;   // peak before the first gearbox was computed
    double peak = 0.0;     // peak afterwards
    double records = 0.0;  // additional memory of a run: motion that was not recorded here
    double kept = 0.0;     // additional memory of a run: motion cached for later tiles
    double held = 0.0;     // memory after the gearboxes, freed blocks included
    // Additional memory of a run with many tiles: free blocks between used ones.
    double fragments = 0.0;
};

struct RunCost {
    int threads = 0;
    double wall_s = 0.0;  // for the tiles
    double task_s = 0.0;  // data common to all threads: path tables, healthy records
    // Additional time of a thread's first tile: its tables, cold caches, new memory.
    double start_s = 0.0;
    std::array<GroupCost, 2> cost;  // indexed by Group
    // Computed gearboxes, one entry per record; rows as in BatchRows.
    std::vector<GearboxId> gearboxes;
    BatchRows rows;
    // Number of mesh periods recorded here and in a run. They differ only if every mesh period is
    // integrated and a tile would take too long. `cost` is that of all mesh periods.
    int recorded = 0, to_record = 0;
    long meshes = 0;  // total number integrated
    std::size_t lanes = 0;
    // Motion that a tile of the run keeps, and tiles that the run integrates.
    double motion_bytes = 0.0;
    IntegrationCounts integrations;
    MemoryUse memory;
};

inline constexpr int kFewestMeshes = 8;

// Computes tiles from the whole ensemble on all threads: two per thread (unless there are fewer or
// they are slow), and more until `budget_s` seconds are over. If every mesh period is integrated
// and a tile would take longer, it records fewer mesh periods, at least kFewestMeshes. The measured
// time is then extrapolated to all mesh periods.
RunCost measure_run_cost(const TilePlan& whole, const EnsemblePlan& ensemble,
                         const BatchPlan& batches, int threads, double budget_s);

// Seconds for thresholds, detection rates and POD of all gearboxes at all noise levels.
double analysis_s(const RowShape& shape, const BatchPlan& plan, int threads);

// Peak memory for assessing all gearboxes of a run.
double assessment_bytes(const RowShape& shape, const BatchPlan& plan);

// Computes the time and memory of a run from the cost of some gearboxes.

// Wall-clock times of a run in one process, s, by the items that `run` reports.
struct RunForecast {
    double setup_s = 0.0;      // set-up of the study and of the data common to all threads
    double gearboxes_s = 0.0;  // until the last thread has finished its last batch
    double detection_s = 0.0;  // and results
    Seconds work;              // sum over all threads, without `rest` and `start_s`
    double memory_bytes = 0.0;

    double total_s() const { return setup_s + gearboxes_s + detection_s; }
};

// Time for `threads` threads to compute the batches of the plan. A thread takes the next batch when
// it is free, so some threads may be idle at the end.
double gearboxes_s(const RunCost& calibration, const BatchPlan& plan,
                   const IntegrationCounts& integrations);

// Peak memory: that of the gearboxes with cached motion, or that of the analysis after them.
double memory_bytes(const MemoryUse& memory, const IntegrationCounts& integrations,
                    double motion_bytes, double analysis_bytes);

// Time for integrating some gearboxes again if the run verifies its numerics; 0 otherwise.
// `chosen`: by numerics.scatter_tolerance, whose pilot has the healthy pairs and computes the
// faulty ones beside them.
double verification_s(const Planner& planner, const RunCost& cost, bool chosen);

// Time for computing some gearboxes with changed assumptions.
double assumptions_s(const Planner& planner, const RunCost& cost);

// Lower limit of the additional memory of a run: the motion of one tile per thread, or the columns
// of the analysis. See memory_bytes() for an estimate.
double least_memory_bytes(double motion_bytes, const RowShape& shape, const BatchPlan& plan,
                          int threads);

// Forecast of a run. `setup_s`: time for starting the program and setting up the scene.
RunForecast forecast_run(const RunCost& cost, const RowShape& shape, const BatchPlan& plan,
                         double verification_s, double setup_s);

}  // namespace gearpod::mc
