// How long the analysis of a run's results takes, measured before there are any: on gearboxes made
// up from a few that were computed.
#pragma once

#include "mc/forecast/calibration.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct AnalysisTrial {
    double total_s = 0.0;    // of all gearboxes and noise levels
    double bytes = 0.0;      // of memory
    double trial_s = 0.0;    // what the trial took
    std::size_t rows = 0;    // gearboxes made up
    std::size_t levels = 0;  // noise levels of the trial
};

// Results of `rows` gearboxes, evenly from the whole ensemble, at the noise levels `levels` (places
// in the study's). Their inputs are those of the run. Their features are those of a computed
// gearbox of the same group and fault size or, where sizes are continuous, of any of the group,
// moved along the feature's trend over the sizes; and moved by what a smoothed bootstrap moves them
// (B. W. Silverman, G. A. Young, Biometrika 74 (1987), 469-479), so that no two are tied that would
// not be in a run. Detection is left to the caller.
Results made_up_results(const Study& study, const RunCalibration& calibration,
                        const BatchPlan& plan, std::size_t rows,
                        const std::vector<std::size_t>& levels);

// Detection and reliability of made-up results as `run` finds them: of all features and as many
// gearboxes as there are, up to kTrialRows, at as many noise levels at once as there are threads,
// from the middle on, until `budget_s` seconds are over. The rest counts in proportion.
AnalysisTrial try_analysis(const Study& study, const RunCalibration& calibration,
                           const BatchPlan& plan, int threads, double budget_s);

inline constexpr std::size_t kTrialRows = 6000;

// Memory that the assessment of all gearboxes of a run has at a time.
double assessment_bytes(const Study& study, const BatchPlan& plan);

}  // namespace gearpod::mc
