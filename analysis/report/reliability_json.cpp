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

namespace {

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

Json to_json(const EpistemicBand& uncertain) {
    if (uncertain.inputs.empty()) {
        return nullptr;
    }
    Json size = Json::array(), lower = Json::array(), upper = Json::array();
    for (const PodPoint& point : uncertain.band) {
        size.push_back(point.size);
        lower.push_back(number(point.lower));
        upper.push_back(number(point.upper));
    }
    return {{"inputs", uncertain.inputs},
            {"a90_low", to_json(uncertain.a90_low)},
            {"a90_high", to_json(uncertain.a90_high)},
            {"band", {{"size", size}, {"lower", lower}, {"upper", upper}}},
            {"refusal", text_or_null(uncertain.refusal)}};
}

Json to_json(const LevelReliability& level) {
    Json by_size = Json::array();
    for (const Auc& auc : level.auc_by_size) {
        by_size.push_back(auc_json(auc));
    }
    return {{"noise_level", level.noise_level},
            {"hit_miss", hit_miss_json(level.hit_miss)},
            {"signal_response", signal_response_json(level.signal_response)},
            {"auc", auc_json(level.auc)},
            {"auc_by_size", by_size},
            {"roc", to_json(level.roc)},
            {"misses", to_json(level.misses)},
            {"uncertain", to_json(level.uncertain)},
            {"by_false_alarm_rate", false_alarm_json(level.by_rate)},
            {"least_cost", level.least_cost ? least_cost_json(*level.least_cost) : Json(nullptr)}};
}

Json to_json(const std::optional<SmallestFault>& smallest) {
    if (!smallest) {
        return nullptr;
    }
    Json json{{"feature", smallest->feature},
              {"size", smallest->size},
              {"from_curve", smallest->from_curve},
              {"source", nullptr}};
    if (!smallest->own) {
        json["source"] = {{"feature", smallest->source.feature},
                          {"noise_level", smallest->source.noise_level}};
    }
    return json;
}

Json to_json(const FeatureRanking& ranking) {
    Json ranks = Json::array();
    for (const FeatureRank& rank : ranking.ranks) {
        ranks.push_back({{"name", rank.name},
                         {"auc", number(rank.auc.auc)},
                         {"lower", number(rank.auc.bounds.lower)},
                         {"upper", number(rank.auc.bounds.upper)},
                         {"p_values", numbers(rank.p_values)}});
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

Json to_json(const HeldOutDetector& detector) {
    return {{"name", detector.name},
            {"auc", auc_json(detector.auc)},
            {"detection", level_json(detector.detection)},
            {"hit_miss", hit_miss_json(detector.pod)}};
}

Json to_json(const SobolIndices& indices) {
    Json inputs = Json::array();
    for (const SobolIndex& index : indices.inputs) {
        inputs.push_back({{"name", index.name},
                          {"unit", index.unit},
                          {"first", number(index.first.share)},
                          {"first_lower", number(index.first.bounds.lower)},
                          {"first_upper", number(index.first.bounds.upper)},
                          {"total", number(index.total)},
                          {"total_lower", number(index.total_bounds.lower)},
                          {"total_upper", number(index.total_bounds.upper)}});
    }
    return {{"gearboxes", indices.count},
            {"explained", number(indices.explained)},
            {"resolution", number(indices.resolution)},
            {"terms", indices.terms},
            {"inputs", inputs},
            {"left_out", indices.left_out},
            {"refusal", text_or_null(indices.refusal)}};
}

Json combined_json(const CombinedDetector& combined) {
    const bool has_result = combined.refusal.empty();
    Json weights = Json::array();
    for (const FeatureWeight& weight : combined.weights) {
        weights.push_back({{"feature", weight.name}, {"weight", number(weight.weight)}});
    }
    return {{"weights", weights},
            {"intercept", has_result ? number(combined.intercept) : Json(nullptr)},
            {"trained_healthy", combined.trained_healthy},
            {"trained_faulty", combined.trained_faulty},
            {"detector", has_result ? to_json(combined.combined) : Json(nullptr)},
            {"single", has_result ? to_json(combined.single) : Json(nullptr)},
            {"gain", has_result ? number(combined.combined.auc.auc - combined.single.auc.auc)
                                : Json(nullptr)},
            {"p_value", has_result ? number(combined.p_value) : Json(nullptr)},
            {"left_out", combined.left_out},
            {"warnings", combined.warnings},
            {"refusal", text_or_null(combined.refusal)}};
}

Json sensitivity_json(const LevelSensitivity& sensitivity) {
    if (sensitivity.feature.empty()) {
        return nullptr;
    }
    return {{"feature", sensitivity.feature},
            {"size_low", number(sensitivity.sizes.low)},
            {"size_high", number(sensitivity.sizes.high)},
            {"misses", to_json(sensitivity.misses)},
            {"values", to_json(sensitivity.values)}};
}

}  // namespace

nlohmann::json reliability_json(const Reliability& reliability, const DetectionRequest& request) {
    Json levels = Json::array(), features = Json::array(), conditions = Json::array();
    for (std::size_t n = 0; n < reliability.rankings.size(); ++n) {
        levels.push_back({{"noise_level", request.noise_levels[n]},
                          {"smallest_fault", to_json(smallest_fault(reliability, n))},
                          {"ranking", to_json(reliability.rankings[n])},
                          {"combined", combined_json(reliability.combined[n])},
                          {"sensitivity", sensitivity_json(reliability.sensitivities[n])}});
    }
    for (std::size_t f = 0; f < reliability.features.size(); ++f) {
        const FeatureReliability& feature = reliability.features[f];
        Json at = Json::array();
        for (std::size_t n = 0; n < feature.levels.size(); ++n) {
            at.push_back(to_json(feature.levels[n]));
            at.back()["smallest_fault"] = to_json(smallest_fault(reliability, n, f));
        }
        features.push_back(
            {{"name", feature.feature}, {"alarm", alarm_name(feature.alarm)}, {"levels", at}});
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

nlohmann::json smallest_faults_json(std::span<const FeatureDetection> detection,
                                    const Reliability* reliability) {
    Json json = Json::array();
    const std::size_t levels = detection.empty() ? 0 : detection.front().levels.size();
    for (std::size_t n = 0; n < levels; ++n) {
        json.push_back(to_json(reliability != nullptr ? smallest_fault(*reliability, n)
                                                      : smallest_fault(detection, n)));
    }
    return json;
}

}  // namespace gearpod::analysis
