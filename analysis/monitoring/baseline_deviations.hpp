// Baseline of one gearbox, learnt from its own first records: mean and scatter of a feature,
// optionally after a linear regression on an operating condition (torque).
#pragma once

#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

// Deviation of each value from the prediction of the first `baseline` values, in standard
// deviations towards the alarm side. NaN for the baseline values themselves. The standard deviation
// is that of the prediction of one further value, s (1 + 1/n + ...)^(1/2). For healthy normal
// values each result therefore follows Student's t with n - 1 degrees of freedom (n - 2 with a
// condition that varies).
//
// `condition`: one entry per value, or empty. All results are NaN if fewer than 3 (with a condition
// 4) of the baseline values are finite, or if all are equal. If the conditions of the baseline are
// all equal, values taken at another condition are NaN. With `baseline` 0 nothing is learnt and the
// values themselves are returned, with their sign reversed for a low alarm.
std::vector<double> baseline_deviations(std::span<const double> values,
                                        std::span<const double> condition, std::size_t baseline,
                                        Alarm alarm);

// Combines the deviations of several features of one gearbox: their sum over its standard
// deviation, given the features' correlations among the baseline records. Most powerful where a
// fault moves all features by the same number of standard deviations. P. C. O'Brien, Biometrics 40
// (1984), 1079-1087 (ordinary least squares). `condition` as above; a record that lacks a value
// of any feature has no result. Features without any deviation (all NaN) are left out. All results
// are NaN if `baseline` is 0. Throws std::invalid_argument if the features have different numbers
// of values.
std::vector<double> fused_deviations(const std::vector<std::vector<double>>& values,
                                     std::span<const double> condition, std::size_t baseline,
                                     std::span<const Alarm> alarms);

}  // namespace gearpod::analysis
