// Computes the time and memory of a run from the cost of some gearboxes.
#pragma once

#include "mc/forecast/analysis_trial.hpp"
#include "mc/forecast/run_cost.hpp"
#include "mc/gearbox/integration_cache.hpp"

namespace gearpod::mc {

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
double gearboxes_s(const RunCost& calibration, const BatchPlan& plan, std::size_t lanes,
                   const IntegrationCounts& integrations);

// Peak memory: that of the gearboxes with cached motion, or that of the analysis after them.
double memory_bytes(const MemoryUse& memory, const IntegrationCounts& integrations,
                    double motion_bytes, double analysis_bytes);

// Time for integrating some gearboxes again if the run verifies its numerics; 0 otherwise.
double verification_s(const Scene& scene, const RunCost& calibration);

// Lower limit of the additional memory of a run: the motion of one tile per thread, or the columns
// of the analysis. See memory_bytes() for an estimate.
double least_memory_bytes(const Scene& scene, const BatchPlan& plan, int threads);

// Forecast of a run. `setup_s`: time for starting the program and setting up the scene. It is an
// upper limit if ensemble.until may end the run earlier.
RunForecast forecast_run(const Scene& scene, const BatchPlan& plan, const RunCost& calibration,
                         const AnalysisTrial& analysis, double setup_s);

}  // namespace gearpod::mc
