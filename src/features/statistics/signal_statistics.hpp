// Statistics of a signal and of its teeth: moments, medians, the worst tooth, and the level of
// rounding errors.
#pragma once

#include <span>
#include <vector>

namespace gearpod::features {

// Median of a small sample; NaN for an empty one.
double median(std::vector<double> values);

// Standardized moment n^(p/2 - 1) sum (x - mean)^p / (sum (x - mean)^2)^(p/2) for even p; the
// kurtosis for p = 4.
double standardised_moment(std::span<const double> values, int power);

// Comparison of the worst tooth of a gear with the other teeth, which needs no healthy gearbox as
// reference.

// Largest over median value. NaN without teeth.
double worst_to_median(std::span<const double> teeth);

// Robust standard score of the largest value against the other teeth,
//
//     z = (max - median) / (1.4826 MAD),
//
// with median and median absolute deviation of the other teeth; 1.4826 makes MAD the standard
// deviation of a normal sample. Simulated teeth without noise are bit-identical, so their MAD is
// zero. A lower bound of 1e-6 of the median, far below any sensor's resolution, keeps z finite (0
// if all teeth are equal). NaN for fewer than two teeth.
double worst_score(std::span<const double> teeth);

}  // namespace gearpod::features
