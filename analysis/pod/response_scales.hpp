// Fits of responses over size on all requested scales, and the choice of one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/pod/bound_rule.hpp"
#include "analysis/pod/response_fit.hpp"

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
    // Box-Cox powers; NaN: the power of greatest likelihood.
    std::vector<double> powers = {1.0, 0.0};
    bool accept_failed_checks = false;    // accept a scale whose checks fail
    std::span<const long> specimen = {};  // specimen of each value; empty: one each
    std::optional<double> target = {};    // size to which a90's bound should come down
    std::string tested = "faulty gearboxes";
    int simulated_tables = 0;  // for simulated_coverage and for growing scatter
};

// Fits every scale. `coarse`: as in ResponseLikelihood.
std::vector<SignalResponseFit> fit_scales(const ResponseRows& rows, bool by_specimen,
                                          const SignalResponseRequest& request,
                                          bool coarse = false);

// Fit of least AIC among those not refused. Fits whose checks fail are left out unless
// `accept_failed_checks`. Null if none is left.
const SignalResponseFit* best_scale(const std::vector<SignalResponseFit>& fits,
                                    bool accept_failed_checks);

// Numbers of the fits that the data support about as well as `best`, which comes first: their AIC
// is within 2 of it (K. P. Burnham, D. R. Anderson, Model Selection and Multimodel Inference
// (2002), section 2.6), and they pass the checks like it.
std::vector<std::size_t> supported_scales(const std::vector<SignalResponseFit>& fits,
                                          const SignalResponseFit& best, bool accept_failed_checks);

}  // namespace gearpod::analysis
