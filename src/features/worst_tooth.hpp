// The worst tooth of a gear against the others: no healthy gearbox is needed for comparison.
#pragma once

#include <span>

namespace gearpod::features {

// Largest over median value. NaN without teeth.
double worst_to_median(std::span<const double> teeth);

// Robust standard score of the largest value against the other teeth,
//
//     z = (max - median) / (1.4826 MAD),
//
// median and median absolute deviation of the other teeth; 1.4826 makes MAD the standard deviation
// of a normal sample. Simulated teeth without noise are alike to the last bit and their MAD is
// zero, so it is not taken below 1e-6 of the median: far less than any sensor tells teeth apart by,
// and z stays finite (0 where all teeth agree). NaN for fewer than two teeth.
double worst_score(std::span<const double> teeth);

}  // namespace gearpod::features
