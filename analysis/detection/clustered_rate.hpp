// Healthy samples of two levels: several recordings of each of fewer gearboxes. Recordings of one
// gearbox resemble each other, so they fix a false-alarm rate less well than as many gearboxes do:
// taken for independent, intervals at 95 % may hold the rate of fewer than half of the thresholds.
#pragma once

#include <span>

#include "analysis/detection/detection_table.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// As threshold_rate_interval(), for values whose gearboxes are given. Where it takes five gearboxes
// or more for an expected alarm, by the effective sample size: the recordings divided by what the
// scatter of alarms between gearboxes is over the binomial one (L. Kish, Survey Sampling (1965),
// section 8.2), and less for few gearboxes, by Student's t (E. L. Korn, B. I. Graubard, Survey
// Methodology 24 (1998), 193-201). Where alarms are rarer than that, the scatter follows from the
// share of the variance that is the gearboxes', as if gearbox and rest had normal scores, so long
// as 20 gearboxes or more have the alarms and what is seen of their scatter does not contradict it.
// Else gearboxes count as one recording each.
Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence);

}  // namespace gearpod::analysis
