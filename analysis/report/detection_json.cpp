#include "analysis/report/detection_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

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

namespace {

InputEffect effect_of(const LevelReliability& level, const std::string& input) {
    const auto& all = level.inputs.inputs;
    const auto found = std::ranges::find(all, input, &InputEffect::name);
    InputEffect none;
    none.statistic = none.p_value = kNan;
    none.refusal = "no gearbox has a value of the feature";
    return found == all.end() ? none : *found;
}

// Every input that varies among the test gearboxes of any feature: its unit, and its effect by
// feature and level.
Json by_input(const Reliability& reliability) {
    Json inputs = Json::object();
    for (const FeatureReliability& feature : reliability.features) {
        for (const LevelReliability& level : feature.levels) {
            for (const InputEffect& effect : level.inputs.inputs) {
                inputs[effect.name]["unit"] = effect.unit;
            }
        }
    }
    for (auto& [name, input] : inputs.items()) {
        for (const FeatureReliability& feature : reliability.features) {
            Json levels = Json::array();
            for (const LevelReliability& level : feature.levels) {
                Json of_level = fields_json(effect_of(level, name));
                of_level["noise_level"] = level.noise_level;
                of_level["size_low"] = number(level.inputs.smallest);
                of_level["size_high"] = number(level.inputs.largest);
                levels.push_back(std::move(of_level));
            }
            input["features"].push_back({{"name", feature.feature}, {"levels", levels}});
        }
    }
    return inputs;
}

// Detection of all faulty gearboxes at every noise level.
Json noise_json(const Reliability& reliability, double confidence) {
    Json features = Json::array();
    for (const FeatureReliability& feature : reliability.features) {
        std::vector<InputBin> bins;
        for (const LevelReliability& level : feature.levels) {
            const double noise = level.noise_level;
            const long tested = level.hit_miss.tests, detected = level.hit_miss.hits;
            if (tested > 0) {
                bins.push_back({noise, noise, noise, tested, detected,
                                static_cast<double>(detected) / static_cast<double>(tested),
                                wilson_interval(detected, tested, confidence)});
            }
        }
        features.push_back({{"name", feature.feature}, {"bins", json_of(bins)}});
    }
    return {{"unit", "1"}, {"features", features}};
}

// Dependence of detection on every random input and on the noise.
Json robustness_json(const Reliability& reliability, const DetectionRequest& request) {
    Json json = by_input(reliability);
    json["noise_level"] = noise_json(reliability, request.confidence);
    return json;
}

}  // namespace

Json to_json(const std::vector<RocPoint>& roc) {
    return columns_json(roc);
}

Json to_json(const EpistemicBand& uncertain) {
    if (uncertain.inputs.empty()) {
        return nullptr;
    }
    Json json = fields_json(uncertain);
    json["band"] = columns_json(uncertain.band);
    json["band"].erase("pod");
    return json;
}

Json to_json(const SmallestFault& smallest) {
    Json json = fields_json(smallest);
    json["source"] = smallest.from_itself ? Json(nullptr) : fields_json(smallest.source);
    return json;
}

Json to_json(const FeatureRank& rank) {
    Json json = fields_json(rank.auc);
    json.erase("healthy");
    json.erase("faulty");
    json.update(fields_json(rank));
    return json;
}

Json to_json(const ConditionLevel& level) {
    Json json = fields_json(level);
    for (Json& cell : json["sizes"]) {
        cell.erase("exact");
    }
    return json;
}

nlohmann::json reliability_json(const Reliability& reliability, const DetectionRequest& request) {
    Json levels = Json::array(), features = Json::array();
    for (std::size_t n = 0; n < reliability.rankings.size(); ++n) {
        levels.push_back({{"noise_level", request.noise_levels[n]},
                          {"smallest_fault", json_of(smallest_fault(reliability, n))},
                          {"ranking", json_of(reliability.rankings[n])}});
    }
    for (std::size_t f = 0; f < reliability.features.size(); ++f) {
        const FeatureReliability& feature = reliability.features[f];
        Json of_levels = json_of(feature.levels);
        for (std::size_t n = 0; n < feature.levels.size(); ++n) {
            of_levels[n]["smallest_fault"] = json_of(smallest_fault(reliability, n, f));
        }
        features.push_back({{"name", feature.feature},
                            {"alarm", alarm_name(feature.alarm)},
                            {"levels", of_levels}});
    }
    return {{"size", json_of(request.size)},
            {"confidence", request.confidence},
            {"levels", levels},
            {"features", features},
            {"conditions", json_of(reliability.conditions)},
            {"robustness", robustness_json(reliability, request)}};
}

nlohmann::json smallest_faults_json(std::span<const FeatureDetection> detection,
                                    const Reliability* reliability) {
    Json json = Json::array();
    const std::size_t levels = detection.empty() ? 0 : detection.front().levels.size();
    for (std::size_t n = 0; n < levels; ++n) {
        json.push_back(json_of(reliability != nullptr ? smallest_fault(*reliability, n)
                                                      : smallest_fault(detection, n)));
    }
    return json;
}

}  // namespace gearpod::analysis
