#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/comparison/comparison_report.hpp"
#include "analysis/report/json_values.hpp"

namespace gearpod::analysis {
namespace {

Json number_json(const NumberDifference& value) {
    return {{"values", {number(value.a), number(value.b)}},
            {"difference", number(value.refusal.empty() ? value.difference() : kNan)},
            {"lower", number(value.bounds.lower)},
            {"upper", number(value.bounds.upper)},
            {"p_value", number(value.p_value)},
            {"refusal", text_or_null(value.refusal)}};
}

Json rate_json(const RateDifference& rate) {
    return {{"size_low", rate.size.low},
            {"size_high", rate.size.high},
            {"tested", {rate.tested_a, rate.tested_b}},
            {"pd", {number(rate.a), number(rate.b)}},
            {"difference", number(rate.b - rate.a)},
            {"lower", number(rate.bounds.lower)},
            {"upper", number(rate.bounds.upper)},
            {"p_value", number(rate.p_value)},
            {"only", rate.pairs.pairs() > 0 ? Json({rate.pairs.only_a, rate.pairs.only_b})
                                            : Json(nullptr)}};
}

}  // namespace

nlohmann::json comparison_json(const ComparedResults& results) {
    Json files = Json::array();
    for (const ComparedFile& file : results.files) {
        Json smallest = Json::array(), features = Json::array();
        for (std::size_t n = 0; n < file.smallest.size(); ++n) {
            Json fault = nullptr;
            if (const auto& found = file.smallest[n]) {
                fault = {{"feature", found->feature},
                         {"size", found->size},
                         {"from_curve", found->from_curve}};
            }
            smallest.push_back({{"noise_level", file.noise_levels[n]},
                                {"fault", fault},
                                {"without_threshold", bool{file.without_threshold[n]}}});
        }
        for (const ComparedFeature& feature : file.features) {
            Json sizes = Json::array();
            for (const RateDifference& rate : feature.comparison.rates) {
                sizes.push_back(rate_json(rate));
            }
            features.push_back({{"name", feature.feature},
                                {"noise_level", feature.noise_level},
                                {"same", feature.same},
                                {"sizes", sizes},
                                {"a90", number_json(feature.comparison.a90)},
                                {"auc", number_json(feature.comparison.auc)}});
        }
        files.push_back({{"path", file.path},
                         {"title", file.title},
                         {"gearboxes", file.gearboxes},
                         {"smallest_faults", smallest},
                         {"shortage", text_or_null(file.shortage)},
                         {"pairs", file.pairs},
                         {"unpaired", text_or_null(file.unpaired)},
                         {"differing_inputs", file.differing},
                         {"left_out", file.left_out},
                         {"features", features}});
    }
    return {{"kind", "comparison"},
            {"size", {{"name", results.size.name}, {"unit", results.size.unit}}},
            {"confidence", results.confidence},
            {"noise_level", results.noise_level},
            {"first_records", results.first_records},
            {"findings", findings_json(comparison_report(results))},
            {"files", files}};
}

}  // namespace gearpod::analysis
