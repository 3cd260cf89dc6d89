// Likelihood-ratio bounds of hit/miss curves with clustered outcomes. The deviance is divided by
// the design effect, the ratio of the cluster-robust to the independent variance of a size: J. N.
// K. Rao, A. J. Scott, Ann. Stat. 12 (1984), 46-60. The robust variance itself is uncertain with
// few clusters, hence the limit is the square of a t quantile with clusters - 2 degrees of freedom.
#pragma once

#include <span>

#include "analysis/pod/curve_covariance.hpp"

namespace gearpod::analysis {

inline constexpr long kFewestClusters = 3;
inline constexpr long kFewClusters = 10;  // below, the bounds are wide and approximate

long count_clusters(std::span<const ClusteredOutcome> outcomes);

// Design effect of the sizes with a POD of 0.5 and 0.9, the larger, and at least 1.
double design_effect(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve);

// Limit of the deviance for one-sided bounds.
double clustered_chi_squared(double effect, long clusters, double confidence);

}  // namespace gearpod::analysis
