// POD from the feature itself over fault size, "a-hat against a" (MIL-HDBK-1823A, appendix G.2;
// ASTM E3023): a straight line through the faulty gearboxes' values, on linear, log or Box-Cox
// scales, with normal scatter of constant variance about it, so that
//
//   POD(a) = Phi(u),   u = +-(intercept + slope x - y(threshold)) / sigma.
//
// Where linearity, constant variance or normality fails, the fit is refused and says so, unless the
// request insists on its scales. The threshold counts as given. A study's values are never censored
// and are fitted by least squares with Wald's bounds of POD; inspections by maximum likelihood,
// with censored values, specimens' random deviations, and Wald's or likelihood-ratio bounds of the
// size.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/pod/response_bounds.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

struct SignalResponseRequest {
    double threshold = 0.0;
    Alarm alarm = Alarm::high;
    double confidence = 0.95;
    int band_points = 21;

    LineMethod method = LineMethod::least_squares;
    BoundRule rule = {BoundMethod::wald, 0.0};  // of a fit by maximum likelihood
    CensoringLimits limits = {};
    std::vector<bool> log_sizes = {false, true};
    std::vector<double> powers = {1.0, 0.0};  // Box-Cox's; NaN: that of greatest likelihood
    bool insist = false;                      // on a scale whose checks fail
    std::span<const long> specimen = {};      // of each value; empty: each has its own
    std::optional<double> target = {};        // size for a90's bound
    std::string tested = "faulty gearboxes";
};

struct SignalResponsePod {
    long count = 0;            // faulty gearboxes with a value
    long left = 0, right = 0;  // of these, censored
    long specimens = 0;        // that have values
    std::string refusal;       // why there is no curve, empty if there is one
    std::vector<SignalResponseFit> candidates;
    std::size_t chosen = 0;  // least AIC of those not refused
    LocationScale curve;     // of the chosen
    BoundRule rule;
    SizeBounds a50, a90;
    std::vector<PodPoint> band;
    double specimens_factor = kNan;  // of those tested, for a90's upper bound at the target
};

// Sizes of 0 are healthy gearboxes and are left out, as are values that are not finite.
SignalResponsePod signal_response_pod(std::span<const double> sizes,
                                      std::span<const double> responses,
                                      const SignalResponseRequest& request);

// The same line against another threshold; its bounds alone.
struct ThresholdBounds {
    SizeBounds a50, a90;
};
ThresholdBounds bounds_at(const SignalResponsePod& pod, const SignalResponseRequest& request,
                          double threshold, double smallest, double largest);

}  // namespace gearpod::analysis
