#include "analysis/report/detector_json.hpp"

#include "analysis/report/detection_json.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/pod_json.hpp"

namespace gearpod::analysis {
namespace {

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

}  // namespace

nlohmann::json combined_json(const CombinedDetector& combined) {
    const bool graded = combined.refusal.empty();
    Json weights = Json::array();
    for (const FeatureWeight& weight : combined.weights) {
        weights.push_back({{"feature", weight.name}, {"weight", number(weight.weight)}});
    }
    return {{"weights", weights},
            {"intercept", graded ? number(combined.intercept) : Json(nullptr)},
            {"trained_healthy", combined.trained_healthy},
            {"trained_faulty", combined.trained_faulty},
            {"detector", graded ? to_json(combined.combined) : Json(nullptr)},
            {"single", graded ? to_json(combined.single) : Json(nullptr)},
            {"gain",
             graded ? number(combined.combined.auc.auc - combined.single.auc.auc) : Json(nullptr)},
            {"p_value", graded ? number(combined.p_value) : Json(nullptr)},
            {"left_out", combined.left_out},
            {"warnings", combined.warnings},
            {"refusal", text_or_null(combined.refusal)}};
}

nlohmann::json sensitivity_json(const LevelSensitivity& sensitivity) {
    if (sensitivity.feature.empty()) {
        return nullptr;
    }
    return {{"feature", sensitivity.feature},
            {"size_low", number(sensitivity.sizes.low)},
            {"size_high", number(sensitivity.sizes.high)},
            {"misses", to_json(sensitivity.misses)},
            {"values", to_json(sensitivity.values)}};
}

}  // namespace gearpod::analysis
