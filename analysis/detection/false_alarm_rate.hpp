// How well a healthy sample fixes the false-alarm rate of its own threshold, whatever the feature's
// distribution. A threshold at the r-th smallest of n continuous values leaves a probability beyond
// it that is Beta(n + 1 - r, r) distributed: S. S. Wilks, Ann. Math. Stat. 12 (1941), 91-96;
// H. A. David, H. N. Nagaraja, Order Statistics (2003), section 2.1. Ties only lower the rate.
#pragma once

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// The rank r that alarm_threshold() takes, 1 <= r <= n; n + 1 if the sample is too small.
long threshold_rank(long sample, double false_alarm_rate);

// Two-sided tolerance interval of the rate of this very threshold. NaN if there is no threshold.
Interval threshold_rate_interval(long sample, double false_alarm_rate, double confidence);

// The smallest healthy sample that has a threshold at the rate.
long sample_for_threshold(double false_alarm_rate);

// The smallest healthy sample from which on, at all larger ones too, the upper bound above is at
// most twice the rate asked for: the rule by which a sample counts as large enough.
long sample_for_rate(double false_alarm_rate, double confidence);

// What is known of a threshold's rate after `tested` further healthy gearboxes gave `alarms`: the
// Beta law above, updated by the binomial count. Its mean and equal-tailed bounds hold over
// repeated studies exactly, since the Beta law is the true scatter of thresholds and no prior
// opinion.
struct HealthyRate {
    double rate = 0.0;
    Interval bounds;
};
HealthyRate healthy_rate(long sample, double false_alarm_rate, long alarms, long tested,
                         double confidence);

// Interval of the expected rate over repeated studies, each with a threshold sample of its own: the
// rates q at which `alarms` or more and `alarms` or fewer both keep a probability of
// (1 - confidence) / 2. The count is beta-binomial, Beta((n + 1) q, (n + 1)(1 - q)), so that the
// threshold's own scatter is in it. NaN if tested or sample is 0.
Interval expected_rate_interval(long sample, long alarms, long tested, double confidence);

}  // namespace gearpod::analysis
