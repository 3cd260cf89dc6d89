#include "analysis/inspection.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/detection/reliable_size.hpp"
#include "analysis/statistics/clopper_pearson.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kInspectionPod = 0.9;
constexpr int kInspectionBandPoints = 61;

BoundRule rule_of(const InspectionRequest& request) {
    const BoundConvention handbooks =
        request.responses ? BoundConvention::one_sided : BoundConvention::two_sided;
    const BoundMethod method = request.method.value_or(
        request.responses ? BoundMethod::wald : BoundMethod::likelihood_ratio);
    switch (request.convention == BoundConvention::handbook ? handbooks : request.convention) {
        case BoundConvention::two_sided:
            return two_sided_bound(request.confidence, method);
        case BoundConvention::joint:
            return joint_bound(request.confidence, method);
        case BoundConvention::handbook:
        case BoundConvention::one_sided:
            break;
    }
    return one_sided_bound(request.confidence, method);
}

void count_specimens(const Inspections& data, InspectionResult& result) {
    std::set<long> specimens;
    long lines = 0;
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        if (data.size[i] > 0.0) {
            specimens.insert(data.specimen[i]);
            ++lines;
        }
    }
    result.specimens = static_cast<long>(specimens.size());
    result.repeats = lines - result.specimens;
}

void add_hit_miss(const Inspections& data, const InspectionRequest& request,
                  InspectionResult& result) {
    HitMissRequest pod_request;
    std::vector<char> hit;
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        hit.push_back(data.value[i] != 0.0);
        if (data.size[i] > 0.0) {
            pod_request.outcomes.push_back({data.size[i], hit.back() != 0, data.specimen[i]});
        } else {
            result.false_calls += hit.back();
        }
    }
    result.table = hit_miss_table(data.size, hit);
    const double rate = result.without_flaw == 0 ? 0.0
                                                 : static_cast<double>(result.false_calls) /
                                                       static_cast<double>(result.without_flaw);
    pod_request.floor = request.floor.value_or(rate);
    pod_request.without_floor = !request.floor;
    pod_request.confidence = request.confidence;
    pod_request.band_points = kInspectionBandPoints;
    pod_request.rule = rule_of(request);
    // Outcomes of one specimen are correlated. Only the robust covariance accounts for this.
    if (result.repeats > 0) {
        pod_request.rule->method = BoundMethod::wald;
    }
    pod_request.links = request.links;
    pod_request.log_sizes = request.log_sizes;
    pod_request.fit_ceiling = request.fit_ceiling && pod_request.rule->method != BoundMethod::wald;
    pod_request.firth = request.firth;
    pod_request.target = request.target;
    pod_request.tested = "specimen";
    result.hit_miss = hit_miss_pod(result.table, pod_request);
}

double threshold_of(const NoiseDistribution& noise, double false_call_rate, Alarm alarm) {
    return noise.exceeded_by(alarm == Alarm::high ? false_call_rate : 1.0 - false_call_rate);
}

// Thresholds for the trade-off: those that the noise exceeds with probabilities from 0.5 to 1e-4,
// or without noise values some quantiles of the responses.
std::vector<double> thresholds(const std::vector<double>& responses, const NoiseDistribution* noise,
                               const InspectionRequest& request) {
    constexpr int kPoints = 33;
    std::vector<double> all;
    for (int i = 0; i < kPoints; ++i) {
        const double share = static_cast<double>(i) / (kPoints - 1);
        if (noise != nullptr) {
            all.push_back(threshold_of(*noise, 0.5 * std::pow(2e-4, share), request.alarm));
        } else {
            const auto at = static_cast<std::size_t>(
                std::lround((0.02 + 0.78 * share) * static_cast<double>(responses.size() - 1)));
            all.push_back(responses[at]);
        }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

double false_call_probability(const NoiseDistribution* noise, double threshold, Alarm alarm) {
    return noise == nullptr       ? kNan
           : alarm == Alarm::high ? noise->above(threshold)
                                  : noise->below(threshold);
}

void add_trade_off(const SignalResponseRequest& pod_request, const std::vector<double>& responses,
                   const InspectionRequest& request, InspectionResult& result) {
    const NoiseDistribution* noise = result.noise.empty() ? nullptr : &result.noise.front();
    const SignalResponsePod& pod = result.signal_response;
    const bool positive = pod.candidates[pod.chosen].scale.power != 1.0;
    for (const double threshold : thresholds(responses, noise, request)) {
        const bool within = threshold > request.limits.left && threshold < request.limits.right;
        if (!within || (positive && !(threshold > 0.0))) {
            continue;
        }
        const ThresholdBounds bounds =
            bounds_at(pod, pod_request, threshold, pod.band.front().size, pod.band.back().size);
        result.trade_off.push_back({threshold,
                                    false_call_probability(noise, threshold, request.alarm),
                                    bounds.a50, bounds.a90});
    }
}

void add_responses(const Inspections& data, const InspectionRequest& request,
                   InspectionResult& result) {
    std::vector<double> without, responses;
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        (data.size[i] > 0.0 ? responses : without).push_back(data.value[i]);
    }
    std::sort(responses.begin(), responses.end());
    result.noise = fit_noise_distributions(without);
    if (request.threshold) {
        result.threshold = *request.threshold;
    } else if (request.false_call_rate && !result.noise.empty()) {
        result.threshold =
            threshold_of(result.noise.front(), *request.false_call_rate, request.alarm);
    } else {
        result.refusal =
            "no threshold: give one, or a false-call rate and at least three lines of size 0 to "
            "derive it from";
        return;
    }
    for (const double value : without) {
        result.false_calls += is_alarm(value, result.threshold, request.alarm);
    }
    SignalResponseRequest pod_request;
    pod_request.threshold = result.threshold;
    pod_request.alarm = request.alarm;
    pod_request.confidence = request.confidence;
    pod_request.band_points = kInspectionBandPoints;
    pod_request.method = LineMethod::maximum_likelihood;
    pod_request.rule = rule_of(request);
    pod_request.limits = request.limits;
    pod_request.log_sizes = request.log_sizes;
    pod_request.powers = request.powers;
    pod_request.accept_failed_checks = request.accept_failed_checks;
    pod_request.specimen = data.specimen;
    pod_request.target = request.target;
    pod_request.tested = "values of flaws";
    result.signal_response = signal_response_pod(data.size, data.value, pod_request);
    if (result.signal_response.refusal.empty()) {
        add_trade_off(pod_request, responses, request, result);
    }
}

}  // namespace

InspectionResult inspect(const Inspections& data, const InspectionRequest& request) {
    InspectionResult result;
    for (const double size : data.size) {
        result.without_flaw += size == 0.0;
    }
    count_specimens(data, result);
    result.all_found = hits_in_a_row(kInspectionPod, request.confidence);
    if (request.responses) {
        add_responses(data, request, result);
    } else {
        add_hit_miss(data, request, result);
    }
    if (result.without_flaw > 0) {
        result.false_call_bounds =
            clopper_pearson_interval(result.false_calls, result.without_flaw, request.confidence);
    }
    return result;
}

}  // namespace gearpod::analysis
