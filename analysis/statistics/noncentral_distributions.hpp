// Noncentral t distribution. Compiled in a file of its own because Boost.Math's templates are slow
// to compile.
#pragma once

namespace gearpod::analysis {

double noncentral_t_cdf(double freedom, double noncentrality, double value);
double noncentral_t_upper_tail(double freedom, double noncentrality, double value);

// Noncentral F distribution: the ratio of a noncentral chi-squared variable to an independent
// central one, each divided by its degrees of freedom (N. L. Johnson, S. Kotz, N. Balakrishnan,
// Continuous Univariate Distributions 2 (1995), chapter 30).

// Probability of a value of at most f. Accurate to 1e-9 for up to a million degrees of freedom and
// any finite noncentrality; NaN for arguments out of range.
double noncentral_f_cdf(double f, double numerator_freedom, double denominator_freedom,
                        double noncentrality);

}  // namespace gearpod::analysis
