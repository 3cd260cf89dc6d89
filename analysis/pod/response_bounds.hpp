// Bounds of a POD curve from a line through responses.
#pragma once

#include "analysis/pod/bound_rule.hpp"
#include "analysis/pod/location_scale.hpp"
#include "analysis/pod/response_fit.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

// POD(x) = Phi((x - location) / scale) of a line and a threshold, with its covariance.
LocationScale curve_of(const SignalResponseFit& fit, double threshold);

// What bounds are read off a response's curve.
class ResponseBounds {
  public:
    virtual ~ResponseBounds() = default;
    virtual SizeBounds size(double pod, double smallest, double largest) const = 0;
    virtual PodPoint point(double size) const = 0;
    // How many times the tested specimens for a bound of the size with that POD at `size`.
    virtual double specimens(double pod, double size) const = 0;
};

// Wald's bounds of POD at a size, whose crossings bound sizes: var u = (variance of the line at x
// + u^2 variance of sigma) / sigma^2, u the distance of the line beyond the threshold in sigmas.
std::unique_ptr<ResponseBounds> bounds_of_pod(const SignalResponseFit& fit, double threshold,
                                              Alarm alarm, double z);
// Wald's bounds of the size with a POD, whose crossings bound POD: MIL-HDBK-1823A, appendix G.2.5.
std::unique_ptr<ResponseBounds> bounds_of_size(const SignalResponseFit& fit, double threshold,
                                               double z);
// By the likelihood ratio; of a fit by maximum likelihood.
std::unique_ptr<ResponseBounds> bounds_of_likelihood(const SignalResponseFit& fit, double threshold,
                                                     Alarm alarm, double limit);

}  // namespace gearpod::analysis
