// Approximate Bayesian computation with regression adjustment: what parameters made the summaries
// that were observed, from draws of the parameters and what was simulated with each.
//
// 1. Summaries are many; each parameter's mean given them, by ridge regression on them and their
//    squares, takes their place: P. Fearnhead, D. Prangle, J. R. Stat. Soc. B 74 (2012), 419-474.
//    It is fitted without the draw's own fifth of the simulations, so that it knows no noise.
// 2. Of the draws the nearest are kept, with Epanechnikov's weights, and moved to the observation
//    along a weighted regression line: M. A. Beaumont, W. Zhang, D. J. Balding, Genetics 162
//    (2002), 2025-2035; residuals are scaled as their spread varies: M. G. B. Blum, O. Francois,
//    Stat. Comput. 20 (2010), 63-73. On the scale of the logit, so that nothing leaves the prior.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::analysis {

struct AbcDraws {
    std::size_t parameters = 0, summaries = 0;
    std::vector<double> unit;        // [draw][parameter], the prior is uniform from 0 to 1
    std::vector<double> summary;     // [draw][summary], finite
    std::vector<std::size_t> group;  // [draw]: draws that share a simulation have the same

    std::size_t size() const { return group.size(); }
};

struct AbcPosterior {
    std::vector<std::size_t> draw;  // those kept
    std::vector<double> weight;     // of each, sum 1
    std::vector<double> unit;       // [kept][parameter], moved to the observation
    // [parameter][summary]: how the draws kept go with it, Spearman's rank correlation
    std::vector<double> correlation;
};

// `share` of the draws are kept, from 0 to 1. Throws std::invalid_argument if the shapes disagree
// or there are fewer than ten draws for a parameter.
AbcPosterior regression_abc(const AbcDraws& draws, std::span<const double> observed, double share);

// Of weighted values: the smallest with at least that much weight at or below it, between them in
// proportion.
double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double probability);

}  // namespace gearpod::analysis
