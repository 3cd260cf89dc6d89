// Rule for the bounds of a POD curve. Each rule holds for one quantity at a time, except the joint
// rule, which holds for the whole curve at once.
#pragma once

#include <string>

namespace gearpod::analysis {

// Likelihood ratio: the range in which the likelihood, maximised over all other parameters, stays
// within a deviance. Wald: a number of standard errors of the size (delta method). Calibrated: a
// bound that covers its confidence in small tables; exact: the same, without simulation.
enum class BoundMethod { likelihood_ratio, wald, calibrated, exact };

struct BoundRule {
    BoundMethod method = BoundMethod::likelihood_ratio;
    // Limit of the deviance, or the square of the number of standard errors.
    double chi_squared = 0.0;

    double limit() const;  // square root of chi_squared
};

// One-sided: chi-squared with one degree of freedom such that each bound alone is exceeded with
// probability 1 - confidence; 2.71 at 95 %.
BoundRule one_sided_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);
// Both bounds together: 3.84 at 95 %, so that each alone is one-sided at 97.5 %. The handbook's
// bounds of hit/miss curves (MIL-HDBK-1823A, appendix G.3.5).
BoundRule two_sided_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);
// Two degrees of freedom, 5.99 at 95 %: R. C. H. Cheng, T. C. Iles, Technometrics 25 (1983), 77-86.
BoundRule joint_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);

// Text such as "likelihood ratio, chi-squared 3.84" or "Wald, 1.645 standard errors".
std::string bound_text(const BoundRule& rule);

}  // namespace gearpod::analysis
