#include "analysis/report/robustness_json.hpp"

#include <algorithm>

#include "analysis/report/json_values.hpp"
#include "analysis/statistics/wilson.hpp"

namespace gearpod::analysis {
namespace {

Json to_json(const InputBin& bin) {
    return {{"low", number(bin.low)},
            {"high", number(bin.high)},
            {"middle", number(bin.middle)},
            {"tested", bin.tested},
            {"detected", bin.detected},
            {"pd", number(bin.pd)},
            {"lower", number(bin.bounds.lower)},
            {"upper", number(bin.bounds.upper)}};
}

Json bins_json(const std::vector<InputBin>& bins) {
    Json list = Json::array();
    for (const InputBin& bin : bins) {
        list.push_back(to_json(bin));
    }
    return list;
}

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
    Json json{{"noise_level", level.noise_level},
              {"size_low", number(level.inputs.smallest)},
              {"size_high", number(level.inputs.largest)},
              {"bins", Json::array()},
              {"statistic", nullptr},
              {"degrees", 0},
              {"p_value", nullptr},
              {"refusal", "no gearbox has a value of the feature"}};
    if (const InputEffect* effect = effect_of(level, input)) {
        json["bins"] = bins_json(effect->bins);
        json["statistic"] = number(effect->statistic);
        json["degrees"] = effect->degrees;
        json["p_value"] = number(effect->p_value);
        json["refusal"] = text_or_null(effect->refusal);
    }
    return json;
}

Json a90_json(const LevelReliability& level, const std::string& input) {
    const InputEffect* effect = effect_of(level, input);
    Json json{{"values", Json::array()},
              {"a90", Json::array()},
              {"refusal", "no gearbox has a value of the feature"}};
    if (effect == nullptr) {
        return json;
    }
    json["values"] = effect->values;
    for (const SizeBounds& bounds : effect->a90) {
        json["a90"].push_back(to_json(bounds));
    }
    json["refusal"] = text_or_null(effect->refusal);
    return json;
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
        features.push_back({{"name", feature.feature}, {"bins", bins_json(bins)}});
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

}  // namespace gearpod::analysis
