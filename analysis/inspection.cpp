#include "analysis/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "analysis/detection/detection.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kInspectionPod = 0.9;
constexpr int kInspectionBandPoints = 61;

BoundRule rule_of(const InspectionRequest& request) {
    const BoundConvention handbooks =
        request.responses ? BoundConvention::one_sided : BoundConvention::two_sided;
    if (request.convention == BoundConvention::calibrated) {
        return one_sided_bound(request.confidence, BoundMethod::calibrated);
    }
    const BoundMethod method = request.method.value_or(
        request.responses ? BoundMethod::wald : BoundMethod::likelihood_ratio);
    switch (request.convention == BoundConvention::handbook ? handbooks : request.convention) {
        case BoundConvention::two_sided:
            return two_sided_bound(request.confidence, method);
        case BoundConvention::joint:
            return joint_bound(request.confidence, method);
        case BoundConvention::calibrated:
        case BoundConvention::handbook:
        case BoundConvention::one_sided:
            break;
    }
    return one_sided_bound(request.confidence, method);
}

// All problems of the data and the request in one text, or "".
std::string problems_of(const Inspections& data, const InspectionRequest& request) {
    std::vector<std::string> problems;
    const auto require = [&](bool holds, const char* problem) {
        if (!holds) {
            problems.emplace_back(problem);
        }
    };
    const auto all = [](const std::vector<double>& values, auto holds) {
        return std::all_of(values.begin(), values.end(), holds);
    };
    require(data.value.size() == data.size.size() && data.specimen.size() == data.size.size(),
            "sizes, values and specimens differ in number");
    require(all(data.size, [](double size) { return std::isfinite(size) && size >= 0.0; }),
            "sizes must be finite and not negative");
    if (request.responses) {
        require(all(data.value, [](double value) { return std::isfinite(value); }),
                "responses must be finite");
    } else {
        require(all(data.value, [](double value) { return value == 0.0 || value == 1.0; }),
                "hits must be 0 or 1");
    }
    require(request.confidence >= 0.5 && request.confidence < 1.0,
            "the confidence must be 0.5 to below 1");
    require(!request.target || (*request.target > 0.0 && std::isfinite(*request.target)),
            "the target must be a size above 0");
    require(!request.floor || (*request.floor >= 0.0 && *request.floor < 1.0),
            "the floor must be 0 to below 1");
    require(!request.threshold || std::isfinite(*request.threshold),
            "the threshold must be finite");
    require(!request.false_call_rate ||
                (*request.false_call_rate > 0.0 && *request.false_call_rate < 1.0),
            "the false-call rate must be between 0 and 1");
    require(request.limits.left < request.limits.right,
            "the left censoring limit must be below the right one");
    return fmt::format("{}", fmt::join(problems, "; "));
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

// Table in which every specimen counts once, divided over its repeats: the handbook's repeated
// inspections (MIL-HDBK-1823A, example 5).
HitMissTable once_per_specimen(const Inspections& data) {
    std::map<long, double> lines;
    std::map<double, HitMissRow> rows;
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        lines[data.specimen[i]] += data.size[i] > 0.0;
    }
    for (std::size_t i = 0; i < data.size.size(); ++i) {
        if (data.size[i] > 0.0) {
            HitMissRow& row = rows[data.size[i]];
            row.size = data.size[i];
            row.tests += 1.0 / lines[data.specimen[i]];
            row.hits += data.value[i] / lines[data.specimen[i]];
        }
    }
    HitMissTable table;
    for (const auto& [size, row] : rows) {
        table.push_back(row);
    }
    return table;
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
    if (!request.floor && rate >= 1.0) {
        result.hit_miss.refusal = fmt::format(
            "all {} specimens without a flaw count as hits, so hits say nothing about flaws",
            result.without_flaw);
        return;
    }
    pod_request.floor = request.floor.value_or(rate);
    pod_request.without_floor = !request.floor;
    pod_request.confidence = request.confidence;
    pod_request.band_points = kInspectionBandPoints;
    pod_request.rule = rule_of(request);
    // Outcomes of one specimen are correlated. Calibrated bounds account for this, and the robust
    // covariance of Wald bounds.
    if (result.repeats > 0 && pod_request.rule->method != BoundMethod::calibrated) {
        if (request.convention == BoundConvention::handbook && !request.method) {
            result.table = once_per_specimen(data);
            result.once_per_specimen = true;
        } else {
            pod_request.rule->method = BoundMethod::wald;
        }
    }
    pod_request.links = request.links;
    pod_request.log_sizes = request.log_sizes;
    pod_request.fit_ceiling = request.fit_ceiling && pod_request.rule->method != BoundMethod::wald;
    pod_request.firth = request.firth;
    pod_request.target = request.target;
    pod_request.tested = "specimen";
    pod_request.simulated_tables = result.repeats > 0 ? 0 : request.simulated_tables;
    result.hit_miss = hit_miss_pod(result.table, pod_request);
    const SizeEstimate& bound = result.hit_miss.a90.upper;
    if (result.hit_miss.refusal.empty() && bound.where == SizeEstimate::Where::reached &&
        result.repeats == 0) {
        for (const ClusteredOutcome& outcome : pod_request.outcomes) {
            result.tests_above += outcome.size >= bound.size;
            result.hits_above += outcome.size >= bound.size && outcome.hit;
        }
        const double both_sides = std::max(1e-6, 2.0 * request.confidence - 1.0);
        result.demonstrated_pod =
            clopper_pearson_interval(result.hits_above, result.tests_above, both_sides).lower;
    }
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
            const auto index = static_cast<std::size_t>(
                std::lround((0.02 + 0.78 * share) * static_cast<double>(responses.size() - 1)));
            all.push_back(responses[index]);
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
    const bool positive = std::any_of(
        pod.supported.begin(), pod.supported.end(),
        [&](std::size_t candidate) { return pod.candidates[candidate].scale.power != 1.0; });
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
            "no threshold: give --threshold, or --false-call-rate and at least three lines of size "
            "0 to derive it from";
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
    pod_request.simulated_tables = request.simulated_tables;
    result.signal_response = signal_response_pod(data.size, data.value, pod_request);
    const SignalResponsePod& pod = result.signal_response;
    if (pod.refusal.empty()) {
        add_trade_off(pod_request, responses, request, result);
    } else if (!pod.candidates.empty() && !request.accept_failed_checks &&
               request.convention == BoundConvention::calibrated && !request.limits.any()) {
        ResponseRows rows;
        for (std::size_t i = 0; i < data.size.size(); ++i) {
            if (data.size[i] > 0.0) {
                rows.size.push_back(data.size[i]);
                rows.value.push_back(data.value[i]);
                rows.specimen.push_back(data.specimen[i]);
            }
        }
        result.smooth.emplace(rows, result.threshold, request.alarm, request.confidence);
    }
}

}  // namespace

const char* convention_name(BoundConvention convention) {
    switch (convention) {
        case BoundConvention::handbook:
            return "handbook";
        case BoundConvention::one_sided:
            return "one-sided";
        case BoundConvention::two_sided:
            return "two-sided";
        case BoundConvention::joint:
            return "joint";
        case BoundConvention::calibrated:
            break;
    }
    return "calibrated";
}

InspectionResult inspect(const Inspections& data, const InspectionRequest& request) {
    if (const std::string problems = problems_of(data, request); !problems.empty()) {
        throw std::invalid_argument("inspections: " + problems);
    }
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
