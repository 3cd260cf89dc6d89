// Where a bound of a POD curve lies. All hold for one quantity at a time but the joint one, which
// holds for the whole curve at once.
#pragma once

#include <string>

namespace gearpod::analysis {

// Likelihood ratio: as far as the likelihood, maximised over everything else, stays within a
// deviance. Wald: so many standard errors of the size (delta method).
enum class BoundMethod { likelihood_ratio, wald };

struct BoundRule {
    BoundMethod method = BoundMethod::likelihood_ratio;
    double chi_squared = 0.0;  // the deviance, or the square of the standard errors

    double limit() const;  // its root
};

// Chi-squared with one degree of freedom so that each bound alone is exceeded with a chance of
// 1 - confidence: 2.71 at 95 %.
BoundRule one_sided_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);
// Both bounds together: 3.84 at 95 %, so that each alone is one-sided at 97.5 %. The handbook's
// bounds of hit/miss curves (MIL-HDBK-1823A, appendix G.3.5).
BoundRule two_sided_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);
// Two degrees of freedom, 5.99 at 95 %: R. C. H. Cheng, T. C. Iles, Technometrics 25 (1983), 77-86.
BoundRule joint_bound(double confidence, BoundMethod method = BoundMethod::likelihood_ratio);

// "likelihood ratio, chi-squared 3.84", "Wald, 1.645 standard errors"
std::string bound_text(const BoundRule& rule);

}  // namespace gearpod::analysis
