// POD from the feature values over fault size, "a-hat against a" (MIL-HDBK-1823A, appendix G.2;
// ASTM E3023): a straight line through the faulty gearboxes' values on linear, log or Box-Cox
// scales, with normal scatter of constant variance about it, so that
//
//   POD(a) = Phi(u),   u = +-(intercept + slope x - y(threshold)) / sigma.
//
// If linearity, constant variance or normality fails, the fit is refused with the reason, unless
// the request insists on its scales. The threshold is taken as exact. A study's values are never
// censored; they are fitted by least squares with Wald bounds of POD. Inspections are fitted by
// maximum likelihood with censored values and random effects of specimens, and with Wald or
// likelihood-ratio bounds of the size.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/pod/response_bounds.hpp"
#include "analysis/pod/response_fit.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct SignalResponsePod {
    long count = 0;            // faulty gearboxes with a value
    long left = 0, right = 0;  // number of them that are censored
    long specimens = 0;        // with values
    std::string refusal;       // reason why there is no curve, empty if there is one
    std::vector<SignalResponseFit> candidates;
    std::size_t chosen = 0;  // least AIC of those not refused
    // Numbers of the candidates that the bounds span, the chosen one first.
    std::vector<std::size_t> supported;
    LocationScale curve;  // of the chosen fit
    BoundRule rule;
    std::shared_ptr<const SimulatedLimits> limits;  // of calibrated bounds
    // Share of tables simulated from the chosen fit in which the bound holds a90. NaN for exact and
    // calibrated bounds.
    double simulated_coverage = kNan;
    // The same if the scatter grew in proportion to the size, and the share of such tables that
    // pass the checks. NaN if not simulated.
    double growing_coverage = kNan, growing_answered = kNan;
    SizeBounds a50, a90;
    std::vector<PodPoint> band;
    // Specimens needed for a90's upper bound at the target, over those tested.
    double specimens_factor = kNan;
};
GEARPOD_FIELDS(SignalResponsePod, count, left_, right_, specimens_, refusal, candidates, chosen,
               supported_, curve_, rule_, limits_, simulated_coverage_, growing_coverage_,
               growing_answered_, a50, a90, band, specimens_factor_)

// Fits all scales and chooses one. Sizes of 0 (healthy gearboxes) and values that are not finite
// are left out.
SignalResponsePod signal_response_pod(std::span<const double> sizes,
                                      std::span<const double> responses,
                                      const SignalResponseRequest& request);

// Bounds of the same line against another threshold.
struct ThresholdBounds {
    SizeBounds a50, a90;
};
ThresholdBounds bounds_at(const SignalResponsePod& pod, const SignalResponseRequest& request,
                          double threshold, double smallest, double largest);

}  // namespace gearpod::analysis
