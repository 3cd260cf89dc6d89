// POD from the feature itself over fault size, "a-hat against a" (MIL-HDBK-1823A, appendix G.2;
// ASTM E3023): a straight line through the faulty gearboxes' values, on linear or log scales, with
// normal scatter of constant variance about it, so that
//
//   POD(a) = Phi(u),   u = +-(intercept + slope x - y(threshold)) / sigma.
//
// Where linearity, constant variance or normality fails, the fit is refused and says so. The bounds
// are Wald's (delta method): var u = leverage(x) + u^2 / (2 (n - 2)). The threshold counts as
// given; no value is censored, as the simulated sensor and encoder do not saturate.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/size_estimate.hpp"
#include "analysis/statistics/regression_line.hpp"

namespace gearpod::analysis {

struct SignalResponseFit {
    bool log_size = false;
    bool log_response = false;
    RegressionLine line;
    double aic = 0.0;  // of the response itself, hence comparable between scales
    std::vector<CheckResult> checks;
    std::vector<std::string> refusals;  // empty if the fit may be used
};

struct SignalResponsePod {
    long count = 0;       // faulty gearboxes with a value
    std::string refusal;  // why there is no curve, empty if there is one
    std::vector<SignalResponseFit> candidates;
    std::size_t chosen = 0;  // least AIC of those not refused
    SizeBounds a50, a90;
    std::vector<PodPoint> band;
};

// Level of each of the three checks: 5 % for the three together (Bonferroni).
inline constexpr double kCheckLevel = 0.05 / 3.0;

// Sizes of 0 are healthy gearboxes and are left out, as are values that are not finite.
SignalResponsePod signal_response_pod(std::span<const double> sizes,
                                      std::span<const double> responses, double threshold,
                                      Alarm alarm, double confidence, int band_points = 21);

}  // namespace gearpod::analysis
