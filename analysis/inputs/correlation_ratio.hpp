// Share of an output's variance that one input explains alone, Var(E[Y | X]) / Var(Y): Pearson's
// correlation ratio, the first-order index of I. M. Sobol, Math. Model. Comput. Exp. 1 (1993),
// 407-414. Estimated from any sample (given-data estimator: E. Plischke, E. Borgonovo, C. L. Smith,
// Eur. J. Oper. Res. 226 (2013), 536-550) in bins of equal counts, less the share that bins without
// influence would explain by chance (T. L. Kelley, Proc. Natl. Acad. Sci. 21 (1935), 554-559).
#pragma once

#include <span>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

struct CorrelationRatio {
    // May be slightly negative by chance without influence. NaN if y or x is constant, or with
    // fewer than 20 values.
    double share = 0.0;
    Interval bounds;  // two-sided, within 0 and 1
};

// Estimates the share in 2 n^(1/3) bins. Bounds are from the noncentral F distribution (J. H.
// Steiger, Psychol. Methods 9 (2004), 164-182). They are widened about the estimate by the ratio of
// two standard deviations: the one from the ratio's influence function, which accounts for the
// distribution of the output, to that under a normal distribution.
CorrelationRatio correlation_ratio(std::span<const double> x, std::span<const double> y,
                                   double confidence);

}  // namespace gearpod::analysis
