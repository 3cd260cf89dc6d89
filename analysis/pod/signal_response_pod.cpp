#include "analysis/pod/signal_response_pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kFewestResponses = 10;  // fewest points for meaningful checks
constexpr double kFoundShare = 0.9;

ResponseRows rows_of(std::span<const double> sizes, std::span<const double> responses,
                     std::span<const long> specimen) {
    ResponseRows rows;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] > 0.0 && std::isfinite(sizes[i]) && std::isfinite(responses[i])) {
            rows.size.push_back(sizes[i]);
            rows.value.push_back(responses[i]);
            if (!specimen.empty()) {
                rows.specimen.push_back(specimen[i]);
            }
        }
    }
    return rows;
}

std::string candidates_refusal(const std::vector<SignalResponseFit>& candidates) {
    std::string text = "no scale passes the checks: ";
    for (const SignalResponseFit& fit : candidates) {
        std::vector<std::string> reasons = fit.refusals;
        reasons.insert(reasons.end(), fit.doubts.begin(), fit.doubts.end());
        text += fmt::format("{}{}: {}", &fit == &candidates.front() ? "" : "; ", fit.scale.text(),
                            fmt::join(reasons, ", "));
    }
    return text;
}

std::string data_refusal(const ResponseRows& rows, const std::set<double>& distinct,
                         const SignalResponseRequest& request) {
    if (!std::isfinite(request.threshold)) {
        return "no threshold";
    }
    if (rows.size.size() < kFewestResponses) {
        return fmt::format("only {} {} with a value, the checks need {}", rows.size.size(),
                           request.tested, kFewestResponses);
    }
    if (distinct.size() < 3) {
        return fmt::format("only {} fault sizes, the linearity check needs three", distinct.size());
    }
    return "";
}

std::vector<SignalResponseFit> fit_all(const ResponseRows& rows, bool by_specimen,
                                       const SignalResponseRequest& request) {
    std::vector<SignalResponseFit> fits;
    for (const double power : request.powers) {
        for (const bool log_size : request.log_sizes) {
            ResponseScale scale{log_size, power};
            if (std::isnan(power)) {
                scale.power =
                    box_cox_power(rows, log_size, request.limits, by_specimen).value_or(0.0);
            }
            fits.push_back(fit_response(rows, scale, request.limits, request.method, by_specimen,
                                        request.threshold, request.alarm));
            if (std::isnan(power)) {
                fits.back().aic += 2.0;  // one more parameter
            }
        }
    }
    return fits;
}

const SignalResponseFit* best_of(const std::vector<SignalResponseFit>& fits,
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

std::unique_ptr<ResponseBounds> bounds_of(const SignalResponseFit& fit, double threshold,
                                          const SignalResponseRequest& request) {
    if (request.method == LineMethod::least_squares) {
        return bounds_of_pod(fit, threshold, request.alarm,
                             link_quantile(Link::probit, request.confidence));
    }
    const double limit = request.rule.limit();
    return request.rule.method == BoundMethod::wald
               ? bounds_of_size(fit, threshold, limit)
               : bounds_of_likelihood(fit, threshold, request.alarm, limit);
}

}  // namespace

SignalResponsePod signal_response_pod(std::span<const double> sizes,
                                      std::span<const double> responses,
                                      const SignalResponseRequest& request) {
    const ResponseRows rows = rows_of(sizes, responses, request.specimen);
    SignalResponsePod pod;
    pod.rule = request.rule;
    pod.count = static_cast<long>(rows.size.size());
    for (const double value : rows.value) {
        pod.left += request.limits.of(value) < 0;
        pod.right += request.limits.of(value) > 0;
    }
    const std::set<long> specimens(rows.specimen.begin(), rows.specimen.end());
    pod.specimens = specimens.empty() ? pod.count : static_cast<long>(specimens.size());
    const std::set<double> distinct(rows.size.begin(), rows.size.end());
    pod.refusal = data_refusal(rows, distinct, request);
    if (!pod.refusal.empty()) {
        return pod;
    }
    pod.candidates = fit_all(rows, pod.specimens < pod.count, request);
    const SignalResponseFit* best = best_of(pod.candidates, request.accept_failed_checks);
    if (best == nullptr) {
        pod.refusal = candidates_refusal(pod.candidates);
        return pod;
    }
    pod.chosen = static_cast<std::size_t>(best - pod.candidates.data());
    pod.curve = curve_of(*best, request.threshold);
    const double smallest = *distinct.begin(), largest = *distinct.rbegin();
    const auto bounds = bounds_of(*best, request.threshold, request);
    pod.a50 = bounds->size(0.5, smallest, largest);
    pod.a90 = bounds->size(kFoundShare, smallest, largest);
    if (request.target) {
        pod.specimens_factor = bounds->specimens(kFoundShare, *request.target);
    }
    for (int i = 0; i < request.band_points; ++i) {
        pod.band.push_back(
            bounds->point(smallest + (largest - smallest) * i / (request.band_points - 1)));
    }
    return pod;
}

ThresholdBounds bounds_at(const SignalResponsePod& pod, const SignalResponseRequest& request,
                          double threshold, double smallest, double largest) {
    const auto bounds = bounds_of(pod.candidates[pod.chosen], threshold, request);
    return {bounds->size(0.5, smallest, largest), bounds->size(kFoundShare, smallest, largest)};
}

}  // namespace gearpod::analysis
