// Bounds of a POD curve from a line through responses.
#pragma once

#include <memory>
#include <vector>

#include "analysis/pod/curve_covariance.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/response_fit.hpp"

namespace gearpod::analysis {

// POD(x) = Phi((x - location) / scale) from a line and a threshold, with its covariance.
LocationScale curve_of(const SignalResponseFit& fit, double threshold);

// Bounds derived from a response fit.
class ResponseBounds {
  public:
    virtual ~ResponseBounds() = default;
    virtual SizeBounds size(double pod, double smallest, double largest) const = 0;
    virtual PodPoint point(double size) const = 0;
    // Number of specimens needed to bring the bound of the size with that POD to `size`, as a
    // factor on the number tested.
    virtual double specimens(double pod, double size) const = 0;
};

// Estimates of the first bounds, and the widest of all bounds.
std::unique_ptr<ResponseBounds> widest_bounds(std::vector<std::unique_ptr<ResponseBounds>> bounds);

// Wald bounds of POD at a size; where they cross a POD they bound the size. var u = (variance of
// the line at x + u^2 variance of sigma) / sigma^2, with u the distance of the line beyond the
// threshold in sigmas.
std::unique_ptr<ResponseBounds> bounds_of_pod(const SignalResponseFit& fit, double threshold,
                                              Alarm alarm, double z);
// Wald bounds of the size with a POD; where they cross a size they bound the POD: MIL-HDBK-1823A,
// appendix G.2.5.
std::unique_ptr<ResponseBounds> bounds_of_size(const SignalResponseFit& fit, double threshold,
                                               double z);
// Likelihood-ratio bounds, for a fit by maximum likelihood.
std::unique_ptr<ResponseBounds> bounds_of_likelihood(const SignalResponseFit& fit, double threshold,
                                                     Alarm alarm, double limit);

}  // namespace gearpod::analysis
