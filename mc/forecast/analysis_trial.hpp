// Estimates the time for the analysis of a run's results before the run, on synthetic results made
// from a few computed gearboxes.
#pragma once

#include "mc/forecast/run_cost.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct AnalysisTrial {
    double total_s = 0.0;    // for all gearboxes and noise levels
    double bytes = 0.0;      // memory
    double trial_s = 0.0;    // time of the trial itself
    std::size_t rows = 0;    // synthetic gearboxes
    std::size_t levels = 0;  // noise levels of the trial
};

// Synthetic results of `rows` gearboxes, evenly spaced in the ensemble, at the noise levels with
// indices `levels`. The inputs are those of the run. The features come from a random computed
// gearbox of the same group and fault size; for continuous sizes, from any of the group, shifted
// along the feature's trend over the size. A smoothed bootstrap (B. W. Silverman, G. A. Young,
// Biometrika 74 (1987), 469-479) avoids ties that a run would not have. Detection results are not
// filled in.
Results synthetic_results(const Scene& scene, const RunCost& calibration, const BatchPlan& plan,
                          std::size_t rows, const std::vector<std::size_t>& levels);

// Runs detection and reliability analysis on synthetic results, as `run` does: all features, up to
// kTrialRows gearboxes, and as many noise levels at once as there are threads, until `budget_s`
// seconds are over. The rest is extrapolated in proportion.
AnalysisTrial measure_analysis(const Scene& scene, const RunCost& calibration,
                               const BatchPlan& plan, int threads, double budget_s);

inline constexpr std::size_t kTrialRows = 6000;

// Peak memory for assessing all gearboxes of a run.
double assessment_bytes(const Study& study, const BatchPlan& plan);

}  // namespace gearpod::mc
