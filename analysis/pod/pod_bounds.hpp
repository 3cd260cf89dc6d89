// Likelihood-ratio bounds of a POD curve: the parameters whose deviance from the maximum stays
// within the chi-squared of a rule (pod_curve.hpp). MIL-HDBK-1823A, appendix G.3.5; R. C. H.
// Cheng, T. C. Iles, Technometrics 25 (1983), 77-86.
#pragma once

#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/pod_likelihood.hpp"

namespace gearpod::analysis {

// Size with a POD of `pod` on the curve of the maximum likelihood.
SizeEstimate size_estimate(const HitMissTable& table, const PodLikelihood& likelihood,
                           const PodLikelihood::Maximum& maximum, double pod);

enum class Side { lower, upper };

// One-sided bound of that size.
SizeEstimate size_bound(const HitMissTable& table, const PodLikelihood& likelihood,
                        const PodLikelihood::Maximum& maximum, double pod, const BoundRule& rule,
                        Side side);

SizeBounds size_bounds(const HitMissTable& table, const PodLikelihood& likelihood,
                       const PodLikelihood::Maximum& maximum, double pod, const BoundRule& rule);

// Estimate of `a` with the lower of the lower bounds and the upper of the upper bounds.
SizeBounds widest(const SizeBounds& a, const SizeBounds& b);

std::vector<PodPoint> pod_band(const PodLikelihood& likelihood,
                               const PodLikelihood::Maximum& maximum,
                               const std::vector<double>& sizes, const BoundRule& rule);

// Number of specimens needed to bring the bound of the size with this POD to `size`, as a factor on
// the number tested, if further specimens were hit and missed alike. Infinite if the curve itself
// lies above `size`.
double specimens_for_bound(const PodLikelihood& likelihood, const PodLikelihood::Maximum& maximum,
                           double pod, double size, const BoundRule& rule);

}  // namespace gearpod::analysis
