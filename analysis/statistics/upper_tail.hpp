// Probabilities of a larger statistic. Infinity has 0, NaN has NaN, and what rounding left below 0
// has 1.
#pragma once

namespace gearpod::analysis {

double chi_squared_upper_tail(double statistic, double degrees);
double f_upper_tail(double statistic, double numerator_degrees, double denominator_degrees);

}  // namespace gearpod::analysis
