#include "analysis/report/reliability_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/reliability.hpp"
#include "analysis/report/detection_json.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

const InputEffect* effect_of(const LevelReliability& level, const std::string& input) {
    for (const InputEffect& effect : level.inputs.inputs) {
        if (effect.name == input) {
            return &effect;
        }
    }
    return nullptr;
}

// Name and unit of every input that varies among the test gearboxes of any feature.
std::vector<std::pair<std::string, std::string>> inputs_of(const Reliability& reliability) {
    std::vector<std::pair<std::string, std::string>> inputs;
    for (const FeatureReliability& feature : reliability.features) {
        for (const LevelReliability& level : feature.levels) {
            for (const InputEffect& effect : level.inputs.inputs) {
                const std::pair entry{effect.name, effect.unit};
                if (std::find(inputs.begin(), inputs.end(), entry) == inputs.end()) {
                    inputs.push_back(entry);
                }
            }
        }
    }
    return inputs;
}

Json effect_json(const LevelReliability& level, const std::string& input) {
    InputEffect none;
    none.statistic = none.p_value = kNan;
    none.refusal = "no gearbox has a value of the feature";
    const InputEffect* effect = effect_of(level, input);
    Json json = fields_json(effect == nullptr ? none : *effect);
    json["noise_level"] = level.noise_level;
    json["size_low"] = number(level.inputs.smallest);
    json["size_high"] = number(level.inputs.largest);
    return json;
}

Json a90_json(const LevelReliability& level, const std::string& input) {
    const InputEffect* effect = effect_of(level, input);
    return effect == nullptr ? Json{{"values", Json::array()},
                                    {"a90", Json::array()},
                                    {"refusal", "no gearbox has a value of the feature"}}
                             : Json{{"values", effect->values},
                                    {"a90", json_of(effect->a90)},
                                    {"refusal", text_or_null(effect->refusal)}};
}

template <typename LevelJson>
Json by_feature(const Reliability& reliability, LevelJson json_of) {
    Json features = Json::array();
    for (const FeatureReliability& feature : reliability.features) {
        Json levels = Json::array();
        for (const LevelReliability& level : feature.levels) {
            levels.push_back(json_of(level));
        }
        features.push_back({{"name", feature.feature}, {"levels", levels}});
    }
    return features;
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

}  // namespace

nlohmann::json robustness_json(const Reliability& reliability, const DetectionRequest& request) {
    Json json = Json::object();
    for (const auto& [name, unit] : inputs_of(reliability)) {
        json[name] = {
            {"unit", unit},
            {"features", by_feature(reliability, [&, &input = name](const LevelReliability& level) {
                 return effect_json(level, input);
             })}};
    }
    json["noise_level"] = noise_json(reliability, request.confidence);
    return json;
}

nlohmann::json a90_maps_json(const Reliability& reliability, const DetectionRequest& request) {
    Json json = Json::object();
    for (const auto& [name, unit] : inputs_of(reliability)) {
        json[name] = {
            {"unit", unit},
            {"noise_levels", request.noise_levels},
            {"features", by_feature(reliability, [&, &input = name](const LevelReliability& level) {
                 return a90_json(level, input);
             })}};
    }
    return json;
}

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
            {"robustness", robustness_json(reliability, request)},
            {"a90_maps", a90_maps_json(reliability, request)}};
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
