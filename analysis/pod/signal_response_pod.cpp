#include "analysis/pod/signal_response_pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gearpod::analysis {
namespace {

constexpr long kFewestResponses = 10;  // fewest points for meaningful checks
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

std::string data_refusal(const SignalResponsePod& pod, const std::set<double>& distinct,
                         const SignalResponseRequest& request) {
    if (!std::isfinite(request.threshold)) {
        return "no threshold";
    }
    if (pod.specimens < pod.count && pod.specimens < kFewestResponses &&
        !request.accept_failed_checks) {
        return fmt::format("only {} specimens with repeated values, the checks need {}",
                           pod.specimens, kFewestResponses);
    }
    if (pod.count < kFewestResponses) {
        return fmt::format("only {} {} with a value, the checks need {}", pod.count, request.tested,
                           kFewestResponses);
    }
    if (distinct.size() < 3) {
        return fmt::format("only {} fault sizes, the linearity check needs three", distinct.size());
    }
    return "";
}

// Bounds of one fit, whose rule and limits are those of `pod`.
std::unique_ptr<ResponseBounds> bounds_of(const SignalResponsePod& pod,
                                          const SignalResponseFit& fit, double threshold,
                                          const SignalResponseRequest& request) {
    if (request.method == LineMethod::least_squares) {
        return bounds_of_pod(fit, threshold, request.alarm,
                             link_quantile(Link::probit, request.confidence));
    }
    switch (pod.rule.method) {
        case BoundMethod::exact:
            return exact_bounds(fit, threshold, request.alarm, request.confidence);
        case BoundMethod::calibrated:
            return simulated_bounds(fit, threshold, request.alarm, pod.limits);
        case BoundMethod::wald:
            return bounds_of_size(fit, threshold, pod.rule.limit());
        case BoundMethod::likelihood_ratio:
            break;
    }
    return bounds_of_likelihood(fit, threshold, request.alarm, pod.rule.limit());
}

// Bounds that span all supported fits if they are calibrated, otherwise of the chosen fit.
std::unique_ptr<ResponseBounds> bounds_of(const SignalResponsePod& pod,
                                          const std::vector<SignalResponseFit>& fits,
                                          const std::vector<std::size_t>& supported,
                                          double threshold, const SignalResponseRequest& request) {
    std::vector<std::unique_ptr<ResponseBounds>> all;
    for (const std::size_t i : supported) {
        all.push_back(bounds_of(pod, fits[i], threshold, request));
    }
    return widest_bounds(std::move(all));
}

std::vector<std::size_t> spanned(const SignalResponsePod& pod,
                                 const std::vector<SignalResponseFit>& fits,
                                 const SignalResponseFit& best,
                                 const SignalResponseRequest& request) {
    if (pod.rule.method == BoundMethod::calibrated) {
        return supported_scales(fits, best, request.accept_failed_checks);
    }
    return {static_cast<std::size_t>(&best - fits.data())};
}

// True if bounds of the fit need no simulation: one given scale, one value per specimen, none
// censored.
bool has_exact_bounds(const SignalResponsePod& pod, const SignalResponseRequest& request) {
    return request.log_sizes.size() == 1 && request.powers.size() == 1 &&
           !std::isnan(request.powers.front()) && pod.specimens == pod.count && pod.left == 0 &&
           pod.right == 0;
}

// Size of which a fit finds a share, within the tested sizes. `growing`: if its scatter is
// proportional to the size. NaN if there is none.
double size_found(const SignalResponseFit& fit, double share, const ResponseRows& rows,
                  const SignalResponseRequest& request, bool growing) {
    const double u = link_quantile(Link::probit, share);
    const auto [smallest, largest] = std::minmax_element(rows.size.begin(), rows.size.end());
    const auto beyond = [&](double size) {
        const double scatter = growing ? proportional_scatter(rows, size) : 1.0;
        return line_distance(fit, size, request.threshold, request.alarm).u - u * scatter;
    };
    double low = *smallest, high = *largest;
    if (!(beyond(low) < 0.0 && beyond(high) > 0.0)) {
        return kNan;
    }
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (beyond(middle) < 0.0 ? low : high) = middle;
    }
    return high;
}

// Share of simulated tables that have a curve, and share of these whose upper bound of a90 holds.
struct SimulatedCoverage {
    double answered = kNan, held = kNan;
};
SimulatedCoverage coverage_of_bound(const SignalResponsePod& pod, const SignalResponseFit& truth,
                                    const ResponseRows& rows, const SignalResponseRequest& request,
                                    bool growing) {
    const double size = size_found(truth, kFoundShare, rows, request, growing);
    if (request.simulated_tables == 0 || std::isnan(size)) {
        return {};
    }
    int fitted = 0, held = 0;
    simulate_responses(
        rows, pod.specimens < pod.count, truth, request, request.simulated_tables, growing,
        [&](const std::vector<SignalResponseFit>& fits, const SignalResponseFit& best) {
            const auto bounds =
                bounds_of(pod, fits, spanned(pod, fits, best, request), request.threshold, request);
            ++fitted;
            held += bounds->specimens(kFoundShare, size) >= 1.0;
        });
    return {static_cast<double>(fitted) / request.simulated_tables,
            fitted == 0 ? kNan : static_cast<double>(held) / fitted};
}

// Fit to simulate from: with the scatter that maximum likelihood underestimates corrected for the
// two coefficients of the line.
SignalResponseFit corrected(const SignalResponsePod& pod, const SignalResponseFit& fit) {
    SignalResponseFit truth = fit;
    ResponseModel& model = truth.model;
    const auto count = static_cast<double>(pod.specimens);
    (model.between > 0.0 ? model.between : model.within) *= std::sqrt(count / (count - 2.0));
    model.sigma = std::hypot(model.between, model.within);
    return truth;
}

// Chooses the limits of calibrated bounds, and simulates the coverage of the bound of a90.
void calibrate(SignalResponsePod& pod, const SignalResponseFit& fit, const ResponseRows& rows,
               const SignalResponseRequest& request) {
    const SignalResponseFit truth = corrected(pod, fit);
    if (pod.rule.method == BoundMethod::calibrated) {
        if (has_exact_bounds(pod, request)) {
            pod.rule.method = BoundMethod::exact;
        } else {
            pod.limits = std::make_shared<const SimulatedLimits>(rows, pod.specimens < pod.count,
                                                                 truth, request);
        }
    } else {
        pod.simulated_coverage = coverage_of_bound(pod, truth, rows, request, false).held;
    }
    if (pod.specimens < pod.count && request.limits.any()) {
        return;  // too slow
    }
    const SimulatedCoverage growing = coverage_of_bound(pod, truth, rows, request, true);
    pod.growing_coverage = growing.held;
    pod.growing_answered = growing.answered;
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
    pod.refusal = data_refusal(pod, distinct, request);
    if (!pod.refusal.empty()) {
        return pod;
    }
    pod.candidates = fit_scales(rows, pod.specimens < pod.count, request);
    const SignalResponseFit* best = best_scale(pod.candidates, request.accept_failed_checks);
    if (best == nullptr) {
        pod.refusal = candidates_refusal(pod.candidates);
        return pod;
    }
    pod.chosen = static_cast<std::size_t>(best - pod.candidates.data());
    pod.curve = curve_of(*best, request.threshold);
    const double smallest = *distinct.begin(), largest = *distinct.rbegin();
    if (request.method == LineMethod::maximum_likelihood) {
        calibrate(pod, *best, rows, request);
        if (pod.limits) {
            pod.refusal = too_few_tables(pod.limits->tables(), request.confidence);
        }
        if (!pod.refusal.empty()) {
            return pod;
        }
    }
    pod.supported = spanned(pod, pod.candidates, *best, request);
    const auto bounds = bounds_of(pod, pod.candidates, pod.supported, request.threshold, request);
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
    const auto bounds = bounds_of(pod, pod.candidates, pod.supported, threshold, request);
    return {bounds->size(0.5, smallest, largest), bounds->size(kFoundShare, smallest, largest)};
}

}  // namespace gearpod::analysis
