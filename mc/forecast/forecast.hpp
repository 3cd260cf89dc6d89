// From what some gearboxes cost to the time and memory of a run.
#pragma once

#include "mc/forecast/analysis_trial.hpp"
#include "mc/forecast/calibration.hpp"
#include "mc/gearbox/march_cache.hpp"

namespace gearpod::mc {

// Wall clock of a run in one process, s, by the lines in which `run` tells it.
struct RunForecast {
    double setup_s = 0.0;      // the study's and what all threads share
    double gearboxes_s = 0.0;  // until the last thread has finished its last batch
    double detection_s = 0.0;  // and results
    Seconds work;              // of all threads, without what `rest` and `start_s` say
    double memory_bytes = 0.0;

    double total_s() const { return setup_s + gearboxes_s + detection_s; }
};

// How long `threads` threads take for the batches of the plan, each the next batch in order as soon
// as it is free: the last batches may leave some of them idle.
double gearboxes_s(const RunCalibration& calibration, const BatchPlan& plan, std::size_t lanes,
                   const MarchCounts& marches);

// The most memory at a time: of the gearboxes with the motions kept, or of the analysis after them.
double memory_bytes(const MemoryUse& memory, const MarchCounts& marches, double motion_bytes,
                    double analysis_bytes);

// How long a run that verifies its numerics marches some gearboxes again; 0 if it does not.
double verification_s(const Scene& scene, const RunCalibration& calibration);

// What a run of so many threads holds beside the memory of this process: the motions of a tile in
// each of them, or, after them, the columns of its analysis. It takes more (memory_bytes).
double least_memory_bytes(const Scene& scene, const BatchPlan& plan, int threads);

// `setup_s`: of the program and the scene. The most it takes: ensemble.until may end it before.
RunForecast forecast_run(const Scene& scene, const BatchPlan& plan,
                         const RunCalibration& calibration, const AnalysisTrial& analysis,
                         double setup_s);

}  // namespace gearpod::mc
