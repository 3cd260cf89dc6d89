// Likelihood-ratio bounds of a POD curve: the parameters whose log likelihood lies within z^2 / 2
// of the maximum, z the normal quantile of the confidence, so that every bound is one-sided at that
// confidence (a90/95 is the upper bound of a90 at 95 %).
// MIL-HDBK-1823A, appendix G.3.5; R. C. H. Cheng, T. C. Iles, Technometrics 25 (1983), 77-86, here
// with one degree of freedom: each bound is one of a single quantity.
#pragma once

#include <vector>

#include "analysis/pod/pod_likelihood.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

// Sizes at which POD is `pod`.
SizeBounds size_bounds(const HitMissTable& table, const PodLikelihood& likelihood,
                       const PodLikelihood::Maximum& maximum, double pod, double confidence);

// a's estimate, between the lower of the lower bounds and the upper of the upper ones.
SizeBounds widest(const SizeBounds& a, const SizeBounds& b);

// The curve with its bounds at `sizes`.
std::vector<PodPoint> pod_band(const PodLikelihood& likelihood,
                               const PodLikelihood::Maximum& maximum,
                               const std::vector<double>& sizes, double confidence);

}  // namespace gearpod::analysis
