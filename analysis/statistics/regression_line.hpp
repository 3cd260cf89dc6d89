// Straight line by least squares, and tests of the normal-theory assumptions on its residuals.
#pragma once

#include <span>
#include <string>

#include "machine/fields.hpp"

namespace gearpod::analysis {

struct RegressionLine {
    double intercept = 0.0;
    double slope = 0.0;
    double sigma = 0.0;  // residual standard deviation with n - 2 degrees of freedom
    double mean_x = 0.0;
    double sum_xx = 0.0;  // sum of squares about the mean
    long count = 0;

    double at(double x) const { return intercept + slope * x; }
    // Variance of at(x) in units of sigma^2.
    double leverage(double x) const;
};

// Fits the line. x and y must have equal length of at least three, otherwise throws
// std::invalid_argument. NaN if sum_xx is 0.
RegressionLine regression_line(std::span<const double> x, std::span<const double> y);

struct CheckResult {
    std::string test;
    double statistic = 0.0;
    double p_value = 0.0;
};
GEARPOD_FIELDS(CheckResult, test, statistic, p_value)

// Lack-of-fit F test against the means of replicated x (N. R. Draper, H. Smith, Applied Regression
// Analysis (1998), section 2.1). If x is not replicated enough, F test of a quadratic term.
CheckResult linearity_check(std::span<const double> x, std::span<const double> y,
                            const RegressionLine& line);

// Test of T. S. Breusch, A. R. Pagan, Econometrica 47 (1979), 1287-1294, studentised after R.
// Koenker, J. Econometrics 17 (1981), 107-112, which does not assume normal residuals.
CheckResult constant_variance_check(std::span<const double> x, std::span<const double> y,
                                    const RegressionLine& line);

// Anderson-Darling test with estimated mean and variance: R. B. D'Agostino, M. A. Stephens,
// Goodness-of-Fit Techniques (1986), table 4.9.
CheckResult normality_check(std::span<const double> x, std::span<const double> y,
                            const RegressionLine& line);

}  // namespace gearpod::analysis
