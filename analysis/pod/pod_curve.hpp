// POD curve as a function of size, its forms, and sizes and probabilities derived from it with
// their bounds.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

// Covariance of a POD curve's parameters, also from clustered outcomes, and Wald and likelihood-
// ratio bounds from it.

// Covariance of a hit/miss curve's intercept and slope from the curve's information. The robust
// covariance is for clustered outcomes (one specimen inspected several times): the scores summed
// over each cluster between two inverse informations, times clusters / (clusters - 1). K.-Y. Liang,
// S. L. Zeger, Biometrika 73 (1986), 13-22.
struct ClusteredOutcome {
    double size = 0.0;
    bool hit = false;
    long cluster = 0;
};

// Robust covariance if `by_cluster`. NaN if the outcomes do not determine both parameters. For
// curves without a fitted ceiling.
Eigen::Matrix2d curve_covariance(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve,
                                 bool by_cluster);

// POD curve in terms of location and scale of the size, POD = F((x - location) / scale), with their
// covariance and Wald bounds of derived quantities (MIL-HDBK-1823A, appendix G.2.5).
struct LocationScale {
    double location = 0.0;  // x where eta is 0: the median for logit and probit, 63 % for cloglog
    double scale = 0.0;     // x per eta, > 0
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

    // x at eta, plus `z` standard errors.
    double at(double eta, double z) const;
    // Inverse of at(): the eta with at(eta, z) = x, which gives the bound of POD at x. Infinite
    // where the bound is open.
    double eta_at(double x, double z) const;
};
GEARPOD_FIELDS(LocationScale, location, scale, covariance)

// Location and scale of eta = intercept + slope x with the covariance of the two.
LocationScale location_scale(double intercept, double slope, const Eigen::Matrix2d& covariance);

// Wald bounds at `z` standard errors, within the tested sizes.
SizeBounds wald_size_bounds(const LocationScale& curve, const PodForm& form, double pod, double z,
                            double smallest, double largest);
std::vector<PodPoint> wald_band(const LocationScale& curve, const PodForm& form, double z,
                                const std::vector<double>& sizes);

// Number of specimens needed to bring the upper bound of the size with this POD to `size`, as a
// factor on the number tested: the square of the ratio of the bound's half-width to the distance
// between `size` and the estimate. Infinite if the curve itself lies above `size`.
double wald_specimens(const LocationScale& curve, const PodForm& form, double pod, double size,
                      double z);

// Likelihood-ratio bounds of hit/miss curves with clustered outcomes. The deviance is divided by
// the design effect, the ratio of the cluster-robust to the independent variance of a size: J. N.
// K. Rao, A. J. Scott, Ann. Stat. 12 (1984), 46-60. The robust variance itself is uncertain with
// few clusters, hence the limit is the square of a t quantile with clusters - 2 degrees of freedom.

inline constexpr long kFewestClusters = 3;
inline constexpr long kFewClusters = 10;  // below, the bounds are wide and approximate

long count_clusters(std::span<const ClusteredOutcome> outcomes);

// Design effect of the sizes with a POD of 0.5 and 0.9, the larger, and at least 1.
double design_effect(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve);

// Limit of the deviance for one-sided bounds.
double clustered_chi_squared(double effect, long clusters, double confidence);

}  // namespace gearpod::analysis
