// Detection rates by the rungs that matter: the frontier's, the study's own and the chosen ones,
// against the closest rung of all.
#pragma once

#include "mc/accuracy/report.hpp"
#include "mc/accuracy/time_left.hpp"

namespace gearpod::mc {

// Fills RungResult::detection, of as many gearboxes as asked for or as there is time for, and what
// is left out.
void measure_detection(const Study& study, const AccuracyRequest& request, const TimeLeft& time,
                       AccuracyReport& report);

}  // namespace gearpod::mc
