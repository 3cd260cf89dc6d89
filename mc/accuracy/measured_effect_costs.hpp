// Cost of a study's optional effects: time and change of the features when an effect is left out,
// or added where the study leaves it out.
#pragma once

#include "mc/accuracy/report.hpp"
#include "mc/accuracy/time_budget.hpp"

namespace gearpod::mc {

// Measures AccuracyReport::effects for the study of `own`, with its solver setting, in a quarter of
// `time`, and records what was omitted.
void measure_effects(const Scene& own, const AccuracyRequest& request, const TimeBudget& time,
                     AccuracyReport& report);

}  // namespace gearpod::mc
