#include "analysis/report/reliability_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/report/detector_json.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/robustness_json.hpp"

namespace gearpod::analysis {
namespace {

Json to_json(const std::vector<PodPoint>& band) {
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

Json to_json(const HitMissPod& pod) {
    Json json = pod.refusal.empty() ? to_json(pod.chosen) : Json::object();
    json["tests"] = pod.tests;
    json["hits"] = pod.hits;
    json["smallest"] = pod.smallest;
    json["largest"] = pod.largest;
    json["refusal"] = text_or_null(pod.refusal);
    json["doubtful"] = pod.doubtful;
    json["supported"] = pod.supported;
    json["a50"] = pod.refusal.empty() ? to_json(pod.a50) : Json(nullptr);
    json["a90"] = pod.refusal.empty() ? to_json(pod.a90) : Json(nullptr);
    json["band"] = to_json(pod.band);
    json["candidates"] = Json::array();
    for (const HitMissFit& fit : pod.candidates) {
        json["candidates"].push_back(to_json(fit));
    }
    return json;
}

Json to_json(const SignalResponseFit& fit) {
    Json checks = Json::array();
    for (const CheckResult& check : fit.checks) {
        checks.push_back({{"test", check.test},
                          {"statistic", number(check.statistic)},
                          {"p_value", number(check.p_value)}});
    }
    return {{"log_size", fit.log_size},
            {"log_response", fit.log_response},
            {"intercept", number(fit.line.intercept)},
            {"slope", number(fit.line.slope)},
            {"sigma", number(fit.line.sigma)},
            {"aic", number(fit.aic)},
            {"checks", checks},
            {"refusals", fit.refusals}};
}

Json to_json(const SignalResponsePod& pod) {
    Json json{{"count", pod.count},
              {"refusal", text_or_null(pod.refusal)},
              {"chosen", pod.refusal.empty() ? Json(pod.chosen) : Json(nullptr)},
              {"a50", pod.refusal.empty() ? to_json(pod.a50) : Json(nullptr)},
              {"a90", pod.refusal.empty() ? to_json(pod.a90) : Json(nullptr)},
              {"band", to_json(pod.band)},
              {"candidates", Json::array()}};
    for (const SignalResponseFit& fit : pod.candidates) {
        json["candidates"].push_back(to_json(fit));
    }
    return json;
}

Json to_json(const Auc& auc) {
    return {{"auc", number(auc.auc)},
            {"lower", number(auc.bounds.lower)},
            {"upper", number(auc.bounds.upper)},
            {"healthy", auc.healthy},
            {"faulty", auc.faulty}};
}

Json to_json(const std::vector<RocPoint>& roc) {
    Json json{{"false_alarm_rate", Json::array()}, {"detection_rate", Json::array()}};
    for (const RocPoint& point : roc) {
        json["false_alarm_rate"].push_back(point.false_alarm_rate);
        json["detection_rate"].push_back(point.detection_rate);
    }
    return json;
}

Json to_json(const MissSensitivity& misses) {
    Json inputs = Json::array();
    for (const InputInfluence& input : misses.inputs) {
        inputs.push_back({{"name", input.name},
                          {"unit", input.unit},
                          {"larger_in_misses", number(input.larger_in_misses)},
                          {"lower", number(input.bounds.lower)},
                          {"upper", number(input.bounds.upper)},
                          {"p_value", number(input.p_value)}});
    }
    return {{"misses", misses.misses},
            {"hits", misses.hits},
            {"smallest", number(misses.smallest)},
            {"largest", number(misses.largest)},
            {"inputs", inputs},
            {"left_out", misses.left_out},
            {"refusal", text_or_null(misses.refusal)}};
}

Json to_json(const LevelReliability& level) {
    Json by_size = Json::array();
    for (const Auc& auc : level.auc_by_size) {
        by_size.push_back(to_json(auc));
    }
    return {{"noise_level", level.noise_level},
            {"hit_miss", to_json(level.hit_miss)},
            {"signal_response", to_json(level.signal_response)},
            {"auc", to_json(level.auc)},
            {"auc_by_size", by_size},
            {"roc", to_json(level.roc)},
            {"misses", to_json(level.misses)}};
}

Json to_json(const std::optional<SmallestFault>& smallest) {
    if (!smallest) {
        return nullptr;
    }
    return {{"feature", smallest->feature},
            {"size", smallest->size},
            {"from_curve", smallest->from_curve}};
}

Json to_json(const FeatureRanking& ranking) {
    Json ranks = Json::array();
    for (const FeatureRank& rank : ranking.ranks) {
        Json p_values = Json::array();
        for (const double p : rank.p_values) {
            p_values.push_back(number(p));
        }
        ranks.push_back({{"name", rank.name},
                         {"auc", number(rank.auc.auc)},
                         {"lower", number(rank.auc.bounds.lower)},
                         {"upper", number(rank.auc.bounds.upper)},
                         {"p_values", p_values}});
    }
    return {{"healthy", ranking.healthy},
            {"faulty", ranking.faulty},
            {"ranks", ranks},
            {"left_out", ranking.left_out},
            {"refusal", text_or_null(ranking.refusal)}};
}

Json to_json(const ConditionDetection& detection) {
    Json levels = Json::array();
    for (const ConditionLevel& level : detection.levels) {
        Json thresholds = Json::array(), sizes = Json::array();
        for (const ConditionThreshold& threshold : level.thresholds) {
            thresholds.push_back({{"condition", threshold.condition},
                                  {"threshold", number(threshold.threshold)},
                                  {"sample", threshold.sample},
                                  {"alarms", threshold.alarms},
                                  {"rate_lower", number(threshold.rate.lower)},
                                  {"rate_upper", number(threshold.rate.upper)}});
        }
        for (const DetectionCell& cell : level.cells) {
            sizes.push_back({{"size_low", cell.size.low},
                             {"size_high", cell.size.high},
                             {"tested", cell.tested},
                             {"detected", cell.detected},
                             {"failed", cell.failed},
                             {"pd", number(cell.pd)},
                             {"lower", number(cell.lower)},
                             {"upper", number(cell.upper)}});
        }
        levels.push_back({{"noise_level", level.noise_level},
                          {"thresholds", thresholds},
                          {"sizes", sizes},
                          {"without_threshold", level.without}});
    }
    return {{"feature", detection.feature},   {"input", detection.input},
            {"unit", detection.unit},         {"levels", levels},
            {"warnings", detection.warnings}, {"refusal", text_or_null(detection.refusal)}};
}

}  // namespace

nlohmann::json hit_miss_json(const HitMissPod& pod) {
    return to_json(pod);
}

nlohmann::json auc_json(const Auc& auc) {
    return to_json(auc);
}

nlohmann::json reliability_json(const Reliability& reliability, const DetectionRequest& request) {
    Json levels = Json::array(), features = Json::array(), conditions = Json::array();
    for (std::size_t n = 0; n < reliability.rankings.size(); ++n) {
        levels.push_back({{"noise_level", request.noise_levels[n]},
                          {"smallest_fault", to_json(smallest_fault(reliability, n))},
                          {"ranking", to_json(reliability.rankings[n])},
                          {"combined", combined_json(reliability.combined[n])},
                          {"sensitivity", sensitivity_json(reliability.sensitivities[n])}});
    }
    for (const FeatureReliability& feature : reliability.features) {
        Json at = Json::array();
        for (std::size_t n = 0; n < feature.levels.size(); ++n) {
            at.push_back(to_json(feature.levels[n]));
            at.back()["smallest_fault"] = to_json(smallest_fault(feature, n));
        }
        features.push_back({{"name", feature.feature},
                            {"alarm", feature.alarm == Alarm::high ? "high" : "low"},
                            {"levels", at}});
    }
    for (const ConditionDetection& detection : reliability.conditions) {
        conditions.push_back(to_json(detection));
    }
    return {{"size", {{"name", request.size.name}, {"unit", request.size.unit}}},
            {"confidence", request.confidence},
            {"levels", levels},
            {"features", features},
            {"conditions", conditions},
            {"robustness", robustness_json(reliability, request)},
            {"a90_maps", a90_maps_json(reliability, request)}};
}

}  // namespace gearpod::analysis
