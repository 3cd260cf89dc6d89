// Approximate Bayesian computation (ABC) with regression adjustment: posterior of the parameters
// that explain the observed summaries, from prior samples of the parameters and the summaries
// simulated with each.
//
// 1. The many summaries are replaced by each parameter's conditional mean given them, by ridge
//    regression on the summaries and their squares: P. Fearnhead, D. Prangle, J. R. Stat. Soc. B 74
//    (2012), 419-474. Five-fold cross-fitting avoids overfitting: the regression for a sample
//    omits the sample's own fold.
// 2. The nearest samples are kept with Epanechnikov weights and adjusted to the observation along a
//    weighted regression line: M. A. Beaumont, W. Zhang, D. J. Balding, Genetics 162 (2002),
//    2025-2035. Residuals are rescaled where their spread varies: M. G. B. Blum, O. Francois, Stat.
//    Comput. 20 (2010), 63-73. Both work on the logit scale, so that no value leaves the prior.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::analysis {

struct AbcSamples {
    std::size_t parameters = 0, summaries = 0;
    std::vector<double> unit;        // [sample][parameter], uniform prior from 0 to 1
    std::vector<double> summary;     // [sample][summary], finite
    std::vector<std::size_t> group;  // [sample]: equal for samples that share a simulation

    std::size_t size() const { return group.size(); }
};

struct AbcPosterior {
    std::vector<std::size_t> draw;  // samples kept
    std::vector<double> weight;     // weights of the samples kept, sum 1
    std::vector<double> unit;       // [kept][parameter], adjusted to the observation
    // Spearman's rank correlation [parameter][summary] over the samples kept.
    std::vector<double> correlation;
};

// Computes the posterior. `share`: share of the samples to keep, from 0 to 1. Throws
// std::invalid_argument if the shapes disagree or if there are fewer than ten samples per
// parameter.
AbcPosterior regression_abc(const AbcSamples& samples, std::span<const double> observed,
                            double share);

// Quantile of weighted values: the value at which the cumulative weight reaches the probability,
// with half of each value's own weight, interpolated linearly.
double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double probability);

}  // namespace gearpod::analysis
