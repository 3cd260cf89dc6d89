// Noncentral t distribution. Compiled in a file of its own because Boost.Math's templates are slow
// to compile.
#pragma once

namespace gearpod::analysis {

double noncentral_t_cdf(double freedom, double noncentrality, double value);
double noncentral_t_upper_tail(double freedom, double noncentrality, double value);

}  // namespace gearpod::analysis
