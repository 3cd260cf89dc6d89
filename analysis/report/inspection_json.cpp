#include "analysis/report/inspection_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "analysis/report/pod_json.hpp"

namespace gearpod::analysis {
namespace {

void add_curve(Json& json, double location, double scale, const Eigen::Matrix2d& covariance) {
    json["location"] = number(location);
    json["scale"] = number(scale);
    json["covariance"] = {number(covariance(0, 0)), number(covariance(0, 1)),
                          number(covariance(1, 1))};
}

Json hit_miss_of(const HitMissPod& pod) {
    Json json = hit_miss_json(pod);
    if (pod.refusal.empty()) {
        const PodCurve& curve = pod.chosen.curve;
        add_curve(json, -curve.intercept / curve.slope, 1.0 / curve.slope, pod.covariance);
    }
    json["simulated_coverage"] = number(pod.simulated_coverage);
    json["clusters"] = pod.clusters;
    json["design_effect"] = number(pod.design_effect);
    return json;
}

Json responses_of(const InspectionResult& result) {
    const SignalResponsePod& pod = result.signal_response;
    Json json = signal_response_json(pod);
    json["threshold"] = number(result.threshold);
    json["censored"] = {pod.left, pod.right};
    json["specimens"] = pod.specimens;
    json["bound"] = bound_text(pod.rule);
    json["simulated_coverage"] = number(pod.simulated_coverage);
    json["growing_scatter"] = {{"answered", number(pod.growing_answered)},
                               {"coverage", number(pod.growing_coverage)}};
    json["smallest"] = pod.band.empty() ? Json(nullptr) : number(pod.band.front().size);
    json["largest"] = pod.band.empty() ? Json(nullptr) : number(pod.band.back().size);
    json["smooth"] = nullptr;
    if (result.smooth && result.smooth->refusal().empty()) {
        const SmoothResponse& smooth = *result.smooth;
        json["smooth"] = {
            {"a50", to_json(smooth.a50())},      {"a90", to_json(smooth.a90())},
            {"smallest", smooth.smallest()},     {"largest", smooth.largest()},
            {"scatter_growth", smooth.growth()}, {"correlation", smooth.correlation()},
            {"band", band_json(smooth.band())},  {"mean", Json::array()}};
        for (const PodPoint& point : smooth.band()) {
            json["smooth"]["mean"].push_back(smooth.mean(point.size));
        }
    }
    if (pod.refusal.empty()) {
        add_curve(json, pod.curve.location, pod.curve.scale, pod.curve.covariance);
        json["model"] = pod.candidates[pod.chosen].scale.text();
        json["doubts"] = pod.candidates[pod.chosen].doubts;
    }
    return json;
}

Json noise_of(const InspectionRequest& request, const InspectionResult& result) {
    Json laws = Json::array();
    for (const NoiseDistribution& law : result.noise) {
        const bool high = request.alarm == Alarm::high;
        laws.push_back({{"law", noise_distribution_name(law.kind)},
                        {"first", number(law.first)},
                        {"second", number(law.second)},
                        {"aic", number(law.aic)},
                        {"at_threshold", number(high ? law.above(result.threshold)
                                                     : law.below(result.threshold))}});
    }
    return {{"calls", result.false_calls},
            {"of", result.without_flaw},
            {"lower", number(result.false_call_bounds.lower)},
            {"upper", number(result.false_call_bounds.upper)},
            {"laws", laws}};
}

}  // namespace

nlohmann::json inspection_json(const Inspections& data, const InspectionRequest& request,
                               const InspectionResult& result, const InspectionNames& words) {
    Json trade_off = Json::array();
    for (const TradeOffPoint& point : result.trade_off) {
        trade_off.push_back({{"threshold", point.threshold},
                             {"false_calls", number(point.false_calls)},
                             {"a50", to_json(point.a50)},
                             {"a90", to_json(point.a90)}});
    }
    const double factor = request.responses ? result.signal_response.specimens_factor
                                            : result.hit_miss.specimens_factor;
    const double more = (factor - 1.0) * static_cast<double>(result.specimens);
    return {{"kind", "inspection"},
            {"table", words.table},
            {"size", {{"name", words.size.name}, {"unit", words.size.unit}}},
            {"value", {{"name", words.value}, {"unit", words.unit}}},
            {"confidence", request.confidence},
            {"convention", convention_name(request.convention)},
            {"specimens", result.specimens},
            {"repeats", result.repeats},
            {"refusal", text_or_null(result.refusal)},
            {"data", {{"size", data.size}, {"value", data.value}}},
            {"hit_miss", request.responses ? Json(nullptr) : hit_miss_of(result.hit_miss)},
            {"signal_response",
             request.responses && result.refusal.empty() ? responses_of(result) : Json(nullptr)},
            {"false_calls", noise_of(request, result)},
            {"trade_off", trade_off},
            {"more_specimens",
             {{"target", request.target ? Json(*request.target) : Json(nullptr)},
              {"factor", number(factor)},
              {"more", std::isfinite(more) ? Json(std::max(0.0, std::ceil(more))) : Json(nullptr)},
              {"all_found", result.all_found}}},
            {"findings", findings_json(inspection_report(request, result, words))}};
}

}  // namespace gearpod::analysis
