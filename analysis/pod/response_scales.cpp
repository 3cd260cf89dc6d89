#include "analysis/pod/response_scales.hpp"

#include <cmath>

namespace gearpod::analysis {

std::vector<SignalResponseFit> fit_scales(const ResponseRows& rows, bool by_specimen,
                                          const SignalResponseRequest& request, bool coarse) {
    std::vector<SignalResponseFit> fits;
    for (const double power : request.powers) {
        for (const bool log_size : request.log_sizes) {
            ResponseScale scale{log_size, power};
            if (std::isnan(power)) {
                scale.power = box_cox_power(rows, log_size, request.limits, by_specimen, coarse)
                                  .value_or(0.0);
            }
            fits.push_back(fit_response(rows, scale, request.limits, request.method, by_specimen,
                                        request.threshold, request.alarm, coarse));
            if (std::isnan(power)) {
                fits.back().aic += 2.0;  // one more parameter
            }
        }
    }
    return fits;
}

const SignalResponseFit* best_scale(const std::vector<SignalResponseFit>& fits,
                                    bool accept_failed_checks) {
    const SignalResponseFit* best = nullptr;
    for (const SignalResponseFit& fit : fits) {
        const bool may = accept_failed_checks ? fit.refusals.empty() : fit.usable();
        if (may && (best == nullptr || fit.aic < best->aic)) {
            best = &fit;
        }
    }
    return best;
}

std::vector<std::size_t> supported_scales(const std::vector<SignalResponseFit>& fits,
                                          const SignalResponseFit& best,
                                          bool accept_failed_checks) {
    constexpr double kSupportedScale = 2.0;
    std::vector<std::size_t> supported{static_cast<std::size_t>(&best - fits.data())};
    for (const SignalResponseFit& fit : fits) {
        const bool may = accept_failed_checks ? fit.refusals.empty() : fit.usable();
        if (&fit != &best && may && fit.aic <= best.aic + kSupportedScale) {
            supported.push_back(static_cast<std::size_t>(&fit - fits.data()));
        }
    }
    return supported;
}

}  // namespace gearpod::analysis
