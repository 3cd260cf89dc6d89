// Terms of binomial log likelihoods of curves P(yes) = floor + (ceiling - floor) F(eta), vectorised
// over outcomes, with the same bits on every processor. P. McCullagh, J. A. Nelder, Generalized
// Linear Models (1989), section 2.5.
#pragma once

#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {

struct OutcomeCurve {
    Link link = Link::logit;
    double floor = 0.0, ceiling = 1.0;
};

// Computes for each of `count` outcomes the logarithm of its probability, the derivative of that
// logarithm by eta, and the Fisher information of eta. `yes` is 1 or 0. Derivative and information
// are 0 where the product of both probabilities is below 1e-290.
void outcome_terms(const OutcomeCurve& curve, long count, const double* eta, const char* yes,
                   double* log_probability, double* slope, double* information);

// Curve of one covariate u: eta = intercept + slope u. Its parameters are `first`, the slope and
// the ceiling. d eta / d first is 1, d eta / d slope is u - origin, and the ceiling changes with
// `first` by `ceiling_by_first` (the origin is 0 and so is the latter for a free curve).
struct OutcomeLine {
    OutcomeCurve curve;
    double intercept = 0.0, slope = 0.0;
    double origin = 0.0, ceiling_by_first = 0.0;
};

// Log likelihood, its derivatives by the three parameters, and their Fisher information.
struct LikelihoodSums {
    double value = 0.0;
    double by_first = 0.0, by_slope = 0.0, by_ceiling = 0.0;
    double first_first = 0.0, first_slope = 0.0, slope_slope = 0.0;
    double first_ceiling = 0.0, slope_ceiling = 0.0, ceiling_ceiling = 0.0;
};

// Adds `count` values u, all with the outcome yes or all with no, that count `weight` times.
void add_outcomes(const OutcomeLine& line, bool yes, long count, const double* u,
                  const double* weight, LikelihoodSums& sums);

}  // namespace gearpod::analysis
