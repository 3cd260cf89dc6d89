#include "analysis/report/detection_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/detection/detection.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/json_values.hpp"

namespace gearpod::analysis {
namespace {

nlohmann::json to_json(const DetectionCell& cell) {
    return {{"size_low", cell.size.low},   {"size_high", cell.size.high},
            {"tested", cell.tested},       {"detected", cell.detected},
            {"failed", cell.failed},       {"pd", number(cell.pd)},
            {"lower", number(cell.lower)}, {"upper", number(cell.upper)},
            {"exact", to_json(cell.exact)}};
}

nlohmann::json to_json(const TailThreshold& tail) {
    nlohmann::json choices = nlohmann::json::array();
    for (const TailChoice& choice : tail.choices) {
        choices.push_back({{"exceedances", choice.exceedances},
                           {"above", number(choice.above)},
                           {"shape", number(choice.shape)},
                           {"scale", number(choice.scale)},
                           {"threshold", number(choice.threshold)},
                           {"rate", number(choice.rate)}});
    }
    return {{"extrapolation", tail.extrapolation}, {"steady", tail.steady}, {"choices", choices}};
}

nlohmann::json to_json(const ImportanceSampledThreshold& importance_sampled) {
    return {{"gearboxes", importance_sampled.gearboxes},
            {"carrying", importance_sampled.contributing},
            {"extrapolation", importance_sampled.extrapolation}};
}

}  // namespace

nlohmann::json level_json(const LevelDetection& level) {
    nlohmann::json sizes = nlohmann::json::array();
    for (const DetectionCell& cell : level.cells) {
        sizes.push_back(to_json(cell));
    }
    nlohmann::json reliable(nullptr);
    if (const auto size = reliable_size(level, kReliablePd)) {
        reliable = {size->low, size->high};
    }
    return {{"noise_level", level.noise_level},
            {"threshold", number(level.threshold)},
            {"threshold_sample", level.threshold_sample},
            {"threshold_alarms", level.threshold_alarms},
            {"threshold_rate", to_json(level.threshold_rate)},
            {"tail", level.tail ? to_json(*level.tail) : nlohmann::json(nullptr)},
            {"tilted", level.importance_sampled ? to_json(*level.importance_sampled)
                                                : nlohmann::json(nullptr)},
            {"healthy_rate", number(level.healthy_rate)},
            {"healthy_rate_bounds", to_json(level.healthy_rate_bounds)},
            {"expected_rate", to_json(level.expected_rate)},
            {"reliable_size", reliable},
            {"sizes", sizes}};
}

nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request, Subject subject) {
    nlohmann::json list = nlohmann::json::array();
    for (const FeatureDetection& feature : features) {
        nlohmann::json levels = nlohmann::json::array();
        for (const LevelDetection& level : feature.levels) {
            levels.push_back(level_json(level));
        }
        list.push_back({{"name", feature.feature},
                        {"alarm", alarm_name(feature.alarm)},
                        {"warnings", feature.warnings},
                        {"levels", levels}});
    }
    return {{"false_alarm_rate", request.false_alarm_rate},
            {"confidence", request.confidence},
            {"shortage", text_or_null(sample_shortage(features, request, subject))},
            {"size", {{"name", request.size.name}, {"unit", request.size.unit}}},
            {"features", list}};
}

namespace {

Json to_json(const HitMissFit& fit) {
    const PodForm& form = fit.curve.form;
    const bool fitted = fit.refusal.empty();
    const auto value = [&](double v) { return fitted ? number(v) : Json(nullptr); };
    return {{"model", form_text(form)},
            {"link", link_name(form.link)},
            {"log_size", form.log_size},
            {"floor", form.floor},
            {"ceiling", value(fit.curve.ceiling)},
            {"intercept", value(fit.curve.intercept)},
            {"slope", value(fit.curve.slope)},
            {"aic", value(fit.aic)},
            {"fit",
             {{"test", fitted ? fit_text(fit.fit) : ""},
              {"statistic", value(fit.fit.statistic)},
              {"degrees", fit.fit.degrees},
              {"p_value", value(fit.fit.p_value)}}},
            {"refusal", text_or_null(fit.refusal)}};
}

Json to_json(const SignalResponseFit& fit) {
    Json checks = Json::array();
    for (const CheckResult& check : fit.checks) {
        checks.push_back({{"test", check.test},
                          {"statistic", number(check.statistic)},
                          {"p_value", number(check.p_value)}});
    }
    std::vector<std::string> refusals = fit.refusals;
    refusals.insert(refusals.end(), fit.doubts.begin(), fit.doubts.end());
    return {{"log_size", fit.scale.log_size},
            {"log_response", fit.scale.power == 0.0},
            {"power", fit.scale.power},
            {"intercept", number(fit.model.intercept)},
            {"slope", number(fit.model.slope)},
            {"sigma", number(fit.model.sigma)},
            {"between", number(fit.model.between)},
            {"within", number(fit.model.within)},
            {"aic", number(fit.aic)},
            {"checks", checks},
            {"refusals", refusals}};
}

}  // namespace

nlohmann::json band_json(const std::vector<PodPoint>& band) {
    Json json{{"size", Json::array()},
              {"pod", Json::array()},
              {"lower", Json::array()},
              {"upper", Json::array()}};
    for (const PodPoint& point : band) {
        json["size"].push_back(number(point.size));
        json["pod"].push_back(number(point.pod));
        json["lower"].push_back(number(point.lower));
        json["upper"].push_back(number(point.upper));
    }
    return json;
}

nlohmann::json hit_miss_json(const HitMissPod& pod) {
    Json json = pod.refusal.empty() ? to_json(pod.chosen) : Json::object();
    json["tests"] = pod.tests;
    json["hits"] = pod.hits;
    json["smallest"] = pod.smallest;
    json["largest"] = pod.largest;
    json["refusal"] = text_or_null(pod.refusal);
    json["doubtful"] = pod.doubtful;
    json["supported"] = pod.supported.size();
    json["a50"] = pod.refusal.empty() ? to_json(pod.a50) : Json(nullptr);
    json["a90"] = pod.refusal.empty() ? to_json(pod.a90) : Json(nullptr);
    json["band"] = band_json(pod.band);
    json["bound"] = bound_text(pod.rule);
    json["candidates"] = Json::array();
    for (const HitMissFit& fit : pod.candidates) {
        json["candidates"].push_back(to_json(fit));
    }
    return json;
}

nlohmann::json signal_response_json(const SignalResponsePod& pod) {
    Json json{{"count", pod.count},
              {"refusal", text_or_null(pod.refusal)},
              {"chosen", pod.refusal.empty() ? Json(pod.chosen) : Json(nullptr)},
              {"a50", pod.refusal.empty() ? to_json(pod.a50) : Json(nullptr)},
              {"a90", pod.refusal.empty() ? to_json(pod.a90) : Json(nullptr)},
              {"band", band_json(pod.band)},
              {"candidates", Json::array()}};
    for (const SignalResponseFit& fit : pod.candidates) {
        json["candidates"].push_back(to_json(fit));
    }
    return json;
}

nlohmann::json auc_json(const Auc& auc) {
    return {{"auc", number(auc.auc)},
            {"lower", number(auc.bounds.lower)},
            {"upper", number(auc.bounds.upper)},
            {"healthy", auc.healthy},
            {"faulty", auc.faulty}};
}

}  // namespace gearpod::analysis
