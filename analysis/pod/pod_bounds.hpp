// Likelihood-ratio bounds of a POD curve: the parameters whose deviance from the maximum stays
// within a rule's chi-squared (bound_rule.hpp). MIL-HDBK-1823A, appendix G.3.5; R. C. H. Cheng, T.
// C. Iles, Technometrics 25 (1983), 77-86.
#pragma once

#include <vector>

#include "analysis/pod/bound_rule.hpp"
#include "analysis/pod/pod_likelihood.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

// Sizes at which POD is `pod`.
SizeBounds size_bounds(const HitMissTable& table, const PodLikelihood& likelihood,
                       const PodLikelihood::Maximum& maximum, double pod, const BoundRule& rule);

// a's estimate, between the lower of the lower bounds and the upper of the upper ones.
SizeBounds widest(const SizeBounds& a, const SizeBounds& b);

// The curve with its bounds at `sizes`.
std::vector<PodPoint> pod_band(const PodLikelihood& likelihood,
                               const PodLikelihood::Maximum& maximum,
                               const std::vector<double>& sizes, const BoundRule& rule);

// How many times the tested specimens it takes, all hit and missed as these were, for the bound
// of the size with this POD to come down to `size`; infinite where the curve itself does not.
double specimens_for_bound(const PodLikelihood& likelihood, const PodLikelihood::Maximum& maximum,
                           double pod, double size, const BoundRule& rule);

}  // namespace gearpod::analysis
