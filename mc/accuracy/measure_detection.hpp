// Detection rates and cost of optional effects as part of `accuracy`.
#pragma once

#include "mc/accuracy/report.hpp"
#include "mc/numerics/time_budget.hpp"

namespace gearpod::mc {

// Fills SettingResult::detection of the most relevant solver settings (the Pareto frontier, the
// study's own and the chosen ones), compared with the most accurate setting. Uses the requested
// number of gearboxes, or as many as there is time for, and records what was omitted.
void measure_detection(const Study& study, const AccuracyRequest& request, const TimeBudget& time,
                       AccuracyReport& report);

// Measures AccuracyReport::effects for the study of `own`, with its solver setting, in a quarter of
// `time`, and records what was omitted.
void measure_effect_costs(const Scene& own, const AccuracyRequest& request, const TimeBudget& time,
                          AccuracyReport& report);

}  // namespace gearpod::mc
