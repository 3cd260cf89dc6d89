// Covariance of a POD curve's parameters, also from clustered outcomes, and Wald and likelihood-
// ratio bounds from it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

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
