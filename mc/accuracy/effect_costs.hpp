// Cost of a study's optional effects as part of `accuracy`.
#pragma once

#include "mc/accuracy/report.hpp"
#include "mc/numerics/time_budget.hpp"

namespace gearpod::mc {

// Measures AccuracyReport::effects for the study of `own`, with its solver setting, in a quarter of
// `time`, and records what was omitted.
void measure_effect_costs(const Scene& own, const AccuracyRequest& request, const TimeBudget& time,
                          AccuracyReport& report);

}  // namespace gearpod::mc
