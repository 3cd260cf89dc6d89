#include "analysis/report/detection_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/detection/detection.hpp"
#include "analysis/pod/hit_miss_pod.hpp"
#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/json_values.hpp"

namespace gearpod::analysis {

Json to_json(const LevelDetection& level) {
    Json json = fields_json(level);
    json["reliable_size"] = json_of(reliable_size(level, kReliablePd));
    return json;
}

nlohmann::json detection_json(std::span<const FeatureDetection> features,
                              const DetectionRequest& request, Subject subject) {
    return {{"false_alarm_rate", request.false_alarm_rate},
            {"confidence", request.confidence},
            {"shortage", text_or_null(sample_shortage(features, request, subject))},
            {"size", json_of(request.size)},
            {"features", json_of(features)}};
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

Json to_json(const SignalResponseFit& fit) {
    Json json = fields_json(fit);
    json.update(fields_json(fit.model));
    json["log_size"] = fit.scale.log_size;
    json["log_response"] = fit.scale.power == 0.0;
    json["power"] = fit.scale.power;
    std::vector<std::string> refusals = fit.refusals;
    refusals.insert(refusals.end(), fit.doubts.begin(), fit.doubts.end());
    json["refusals"] = refusals;
    return json;
}

Json to_json(const std::vector<PodPoint>& band) {
    return columns_json(band);
}

Json to_json(const HitMissPod& pod) {
    const bool fitted = pod.refusal.empty();
    Json json = fitted ? to_json(pod.chosen) : Json::object();
    json.update(fields_json(pod));
    json["supported"] = pod.supported.size();
    json["a50"] = fitted ? json_of(pod.a50) : Json(nullptr);
    json["a90"] = fitted ? json_of(pod.a90) : Json(nullptr);
    json["bound"] = bound_text(pod.rule);
    return json;
}

Json to_json(const SignalResponsePod& pod) {
    Json json = fields_json(pod);
    if (!pod.refusal.empty()) {
        json["chosen"] = json["a50"] = json["a90"] = nullptr;
    }
    return json;
}

}  // namespace gearpod::analysis
