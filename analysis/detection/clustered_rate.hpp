// False-alarm rate of a two-level healthy sample: several recordings of each of fewer gearboxes.
// Recordings of one gearbox are correlated, so they determine a false-alarm rate less well than as
// many gearboxes do. Treated as independent, 95 % intervals may cover the rate of fewer than half
// of the thresholds.
#pragma once

#include <span>

#include "analysis/detection/detection_table.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Counterpart of threshold_rate_interval() for values grouped by gearbox. Three cases:
//
// - At least five expected alarming gearboxes (gearboxes x rate): effective sample size, the number
//   of recordings divided by the ratio of the scatter of alarms between gearboxes to the binomial
//   one (L. Kish, Survey Sampling (1965), section 8.2), reduced for few gearboxes by Student's t
//   (E. L. Korn, B. I. Graubard, Survey Methodology 24 (1998), 193-201).
// - Rarer alarms: the scatter follows from the gearboxes' share of the variance, as if gearbox and
//   remainder had normal scores. This needs enough gearboxes with alarms (rare_interval()) and
//   observed scatter that does not contradict it.
// - Otherwise each gearbox counts as one recording.
Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence);

}  // namespace gearpod::analysis
