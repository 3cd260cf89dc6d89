// False-alarm rate of a threshold set by a healthy sample, whatever the feature's distribution.
// With a threshold at the r-th smallest of n continuous values, the probability beyond it is Beta(n
// + 1 - r, r) distributed: S. S. Wilks, Ann. Math. Stat. 12 (1941), 91-96; H. A. David, H. N.
// Nagaraja, Order Statistics (2003), section 2.1. Ties only lower the rate.
#pragma once

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// Rank r used by alarm_threshold(), 1 <= r <= n; n + 1 if the sample is too small.
long threshold_rank(long sample, double false_alarm_rate);

// Two-sided tolerance interval of the rate of one given threshold. NaN if there is no threshold.
Interval threshold_rate_interval(long sample, double false_alarm_rate, double confidence);

// Smallest healthy sample that has a threshold at the rate.
long sample_for_threshold(double false_alarm_rate);

// Smallest healthy sample for which, and for all larger ones, the upper bound of
// threshold_rate_interval() is at most twice the requested rate. A sample of this size counts as
// large enough.
long sample_for_rate(double false_alarm_rate, double confidence);

// Rate of a threshold after `alarms` of `tested` further healthy gearboxes: the Beta distribution
// above, updated by the binomial count. Mean and equal-tailed bounds are exact over repeated
// studies, because the Beta distribution is the true distribution of thresholds, not a prior
// opinion.
struct HealthyRate {
    double rate = 0.0;
    Interval bounds;
};
HealthyRate healthy_rate(long sample, double false_alarm_rate, long alarms, long tested,
                         double confidence);

// Interval of the expected rate over repeated studies that each set their own threshold: the rates
// q at which both `alarms` or more and `alarms` or fewer keep a probability of (1 - confidence) /
// 2. The count is beta-binomial, Beta((n + 1) q, (n + 1)(1 - q)), which includes the scatter of the
// threshold. NaN if tested or sample is 0.
Interval expected_rate_interval(long sample, long alarms, long tested, double confidence);

}  // namespace gearpod::analysis
