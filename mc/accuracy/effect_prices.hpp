// Price of a study's optional effects: time and change of the features when an effect is left out,
// or added where the study leaves it out.
#pragma once

#include "mc/accuracy/report.hpp"
#include "mc/accuracy/time_budget.hpp"

namespace gearpod::mc {

// Measures AccuracyReport::effects with the study's own solver setting in a quarter of `time`, and
// records what was omitted. Precondition: `study` has no numerics.tolerance.
void measure_effects(const Study& study, const AccuracyRequest& request, const TimeBudget& time,
                     AccuracyReport& report);

}  // namespace gearpod::mc
