// POD curve as a function of size, its forms, and sizes and probabilities derived from it with
// their bounds.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "analysis/statistics/link.hpp"
#include "machine/fields.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {

// Size at which the curve reaches a POD. Curves are not extrapolated beyond the tested sizes.
struct SizeEstimate {
    enum class Where { reached, below_tested, not_reached };
    Where where = Where::not_reached;
    double size = 0.0;  // if reached, otherwise NaN
};

// Ordering: below the tested sizes < reached < not reached.
inline double place_of(const SizeEstimate& estimate) {
    using Where = SizeEstimate::Where;
    return estimate.where == Where::below_tested ? -std::numeric_limits<double>::infinity()
           : estimate.where == Where::reached    ? estimate.size
                                                 : std::numeric_limits<double>::infinity();
}

inline SizeEstimate estimate_within(double size, double smallest, double largest) {
    if (!(size <= largest)) {
        return {SizeEstimate::Where::not_reached, kNan};
    }
    return size < smallest ? SizeEstimate{SizeEstimate::Where::below_tested, kNan}
                           : SizeEstimate{SizeEstimate::Where::reached, size};
}

struct SizeBounds {
    SizeEstimate estimate;
    SizeEstimate lower;  // one-sided
    SizeEstimate upper;  // one-sided: a90/95 for a90 at 95 %
};
GEARPOD_FIELDS(SizeBounds, estimate, lower, upper)

struct PodPoint {
    double size = 0.0;
    double pod = 0.0;
    double lower = 0.0;  // lower and upper are one-sided
    double upper = 0.0;
};
GEARPOD_FIELDS(PodPoint, size, pod, lower, upper)

// Rule for the bounds of a POD curve. Each rule holds for one quantity at a time, except the joint
// rule, which holds for the whole curve at once.

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

// Probability of detection as a function of fault size:
//
//   POD(a) = floor + (ceiling - floor) F(intercept + slope x),   x = a or ln a.
//
// MIL-HDBK-1823A, appendix G.3.3, has floor 0 and ceiling 1. A detector with a false-alarm rate
// does not fall below it for small faults. A detector that fails on some gearboxes does not reach
// 1. For asymptotes in POD see Annis, Gandossi and Martin, Nucl. Eng. Des. 262 (2013), 98-105.
struct PodForm {
    Link link = Link::logit;
    bool log_size = false;
    double floor = 0.0;         // fixed at the rate of the healthy gearboxes
    bool free_ceiling = false;  // false: the ceiling is 1
    bool firth = false;         // Jeffreys' penalty on the likelihood; not with a free ceiling

    int parameters() const { return free_ceiling ? 3 : 2; }
    double scaled(double size) const;  // x of a size
    double size(double scaled) const;
};

// Text such as "logit of log size, floor 0.05, ceiling fitted" or "logit of size, Firth's penalty".
std::string form_text(const PodForm& form);

struct PodCurve {
    PodForm form;
    double intercept = 0.0;
    double slope = 0.0;  // per unit of x
    double ceiling = 1.0;

    double pod(double size) const;
    // Empty unless floor < pod < ceiling and the curve rises.
    std::optional<double> size_at(double pod) const;
};

}  // namespace gearpod::analysis
