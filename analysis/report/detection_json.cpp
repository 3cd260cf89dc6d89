#include "analysis/report/detection_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/detection/reliable_size.hpp"
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

}  // namespace gearpod::analysis
