// Quantiles and probabilities of the usual distributions. The Boost.Math templates are compiled
// here only, because they take longer to compile than all their callers. Results are NaN or
// infinity where an argument or a result is out of range (quiet_policy.hpp).
#pragma once

namespace gearpod::analysis {

double normal_cdf(double value);
double normal_quantile(double probability);
double normal_upper_tail(double value);
double normal_upper_quantile(double tail);

// Probability that both of two standard normals with `correlation` (0 to 1) exceed the value that
// each exceeds with probability `rate`. Rounding errors are about 1e-15 of `rate`.
double both_exceed(double rate, double correlation);

double student_quantile(double freedom, double probability);

double beta_cdf(double a, double b, double value);
double beta_quantile(double a, double b, double probability);
double beta_upper_quantile(double a, double b, double tail);

double gamma_quantile(double shape, double scale, double probability);
double gamma_upper_quantile(double shape, double scale, double tail);

// P(at most `found` successes in `tried` trials).
double binomial_cdf(double tried, double rate, double found);

double log_gamma(double value);

// Upper tail probabilities. A statistic of infinity gives 0, NaN gives NaN, and a value that
// rounding left below 0 gives 1.

double chi_squared_upper_tail(double statistic, double degrees);
double f_upper_tail(double statistic, double numerator_degrees, double denominator_degrees);

}  // namespace gearpod::analysis
