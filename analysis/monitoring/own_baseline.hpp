// What is normal for one gearbox, learnt from its own first records: mean and scatter of a feature,
// on request after a straight line in what the records were taken at (torque).
#pragma once

#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

// By how many standard deviations each of a gearbox's values lies from what its first `baseline`
// ones predict, towards the alarm; NaN for those first ones themselves. The standard deviation is
// that of a further value's prediction, so that its own share of s (1 + 1/n + ...)^(1/2) is in it:
// of healthy normal values each result is Student's t with n - 1 (with a condition n - 2) degrees
// of freedom. `condition`: one a value, or empty. All NaN if fewer than 3 (4) of the first values
// are finite, or all are alike; and where the first ones' conditions are all alike, those of values
// taken at another one. With `baseline` 0 nothing is learnt: the values themselves, with
// their sign turned for a low alarm.
std::vector<double> own_deviations(std::span<const double> values,
                                   std::span<const double> condition, std::size_t baseline,
                                   Alarm alarm);

// Several features' deviations of one gearbox as one: their sum over its standard deviation, with
// the correlations that the features have among the baseline's records; most powerful where a fault
// moves all by as many standard deviations. P. C. O'Brien, Biometrics 40 (1984), 1079-1087
// (ordinary least squares). `values` and `conditions` as above; a record that lacks a feature's
// value has none. Features that never deviate (all NaN) are left out.
std::vector<double> fused_deviations(const std::vector<std::vector<double>>& values,
                                     std::span<const double> condition, std::size_t baseline,
                                     std::span<const Alarm> alarms);

}  // namespace gearpod::analysis
