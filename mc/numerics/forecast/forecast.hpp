// Estimates the time and memory of a run before it, from the measured cost of some gearboxes.
#pragma once

#include <cstdint>
#include <functional>

#include "mc/numerics/forecast/run_cost.hpp"
#include "mc/plan/planner.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Rows of the measured gearboxes, the first record of each, up to `most`.
class MeasuredRows final : public RowSource {
  public:
    explicit MeasuredRows(const RunCost& cost, std::size_t most = SIZE_MAX);
    std::size_t rows() const override { return block_.count(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override;

  private:
    RowBlock block_;
};

struct AnalysisCost {
    double total_s = 0.0;     // for all gearboxes of the run
    double bytes = 0.0;       // memory
    double measured_s = 0.0;  // for the measured gearboxes
};

// Times detection and reliability analysis of the measured gearboxes, as `run` does them, and
// multiplies by the number of gearboxes. 0 s if none was computed.
AnalysisCost measure_analysis(const EnsemblePlan& ensemble, const RunCost& measured,
                              const BatchPlan& plan, int threads);

// Peak memory for assessing all gearboxes of a run.
double assessment_bytes(const RowShape& shape, const BatchPlan& plan);

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
double verification_s(const Planner& planner, const RunCost& cost);

// Lower limit of the additional memory of a run: the motion of one tile per thread, or the columns
// of the analysis. See memory_bytes() for an estimate.
double least_memory_bytes(double motion_bytes, const RowShape& shape, const BatchPlan& plan,
                          int threads);

// Forecast of a run. `setup_s`: time for starting the program and setting up the scene. It is an
// upper limit if ensemble.until may end the run earlier.
RunForecast forecast_run(const RunCost& cost, const BatchPlan& plan, const AnalysisCost& analysis,
                         double verification_s, double setup_s);

}  // namespace gearpod::mc
