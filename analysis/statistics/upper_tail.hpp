// Upper tail probabilities. A statistic of infinity gives 0, NaN gives NaN, and a value that
// rounding left below 0 gives 1.
#pragma once

namespace gearpod::analysis {

double chi_squared_upper_tail(double statistic, double degrees);
double f_upper_tail(double statistic, double numerator_degrees, double denominator_degrees);

}  // namespace gearpod::analysis
