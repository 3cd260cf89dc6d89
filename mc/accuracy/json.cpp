// accuracy_json(): writes an accuracy report as JSON.
#include <nlohmann/json.hpp>

#include "analysis/report/json_values.hpp"
#include "lockstep/steps/step_limit.hpp"
#include "mc/accuracy/report.hpp"
#include "mc/files/json_text.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {
namespace {

using Json = nlohmann::json;

Json errors(const AccuracyReport& report, const PilotError& error) {
    Json all{{"sensor", analysis::number(error.sensor)},
             {"te", analysis::number(error.te)},
             {"worst_feature", analysis::number(error.largest_feature())},
             {"worst_of_scatter", analysis::number(report.largest_share_of_scatter(error))}};
    for (std::size_t f = 0; f < report.features.size(); ++f) {
        all["features"][report.features[f]] =
            analysis::number(error.feature(static_cast<int>(f), report.levels()));
        all["of_scatter"][report.features[f]] =
            analysis::number(report.share_of_scatter(error, static_cast<int>(f)));
    }
    return all;
}

Json setting_json(const AccuracyReport& report, const SettingResult& r) {
    Json row{{"name", r.setting.text()},
             {"integrator", r.setting.integrator()},
             {"precision",
              r.setting.numerics.precision == Precision::single_precision ? "single" : "double"},
             {"overrides", r.setting.overrides()}};
    if (!r.refusal.empty()) {
        row["refused"] = r.refusal;
        return row;
    }
    row.update({{"steps", r.steps},
                {"settle_tolerance", r.setting.numerics.convergence_tolerance},
                {"integrated_meshes", r.meshes},
                {"failed", r.failed},
                {"gearbox_s", r.integration_s},
                {"gearbox_median_s", r.integration_median_s},
                {"gearbox_with_features_s", r.total_s},
                {"mesh_s", r.mesh_s},
                {"modelled_cost", r.cost},
                {"frontier", r.frontier},
                {"error", errors(report, r.error)}});
    if (r.detection) {
        const DetectionChange& d = *r.detection;
        row["detection"] = {{"gearboxes", d.gearboxes},
                            {"alarms_changed", d.alarms},
                            {"pd_change", d.pd},
                            {"pd_half_width", d.pd_half_width},
                            {"a90_change", d.a90 < 0.0 ? Json(nullptr) : Json(d.a90)},
                            {"a90_interval", analysis::number(d.a90_interval)}};
    }
    return row;
}

Json choice_json(const AccuracyReport& report, const ChoiceCheck& c) {
    Json row{{"tolerance", c.tolerance}};
    if (c.chosen < 0) {
        row["refused"] = c.refusal;
        return row;
    }
    row["chosen"] = report.settings[static_cast<std::size_t>(c.chosen)].setting.text();
    if (c.best >= 0) {
        row["fastest"] = report.settings[static_cast<std::size_t>(c.best)].setting.text();
        row["time_over_fastest"] = c.over_best;
    }
    return row;
}

Json effect_json(const AccuracyReport& report, const MeasuredEffect& e) {
    Json row{{"effect", e.effect}, {"in_study", e.in_study}};
    if (!e.refusal.empty()) {
        row["refused"] = e.refusal;
        return row;
    }
    row["time_ratio"] = e.time_ratio;
    row["change"] = errors(report, e.change);
    row["needed"] = report.matters(e.change);
    return row;
}

Json peer_json(const PeerResult& p) {
    Json row{{"name", p.name},     {"command", p.command}, {"gearbox_s", p.integration_s},
             {"mesh_s", p.mesh_s}, {"sensor", p.sensor},   {"te", p.te}};
    double worst = 0.0;
    for (const auto& [feature, error] : p.features) {
        row["features"][feature] = analysis::number(error);
        worst = std::max(worst, error);
    }
    row["worst_feature"] = p.features.empty() ? Json(nullptr) : analysis::number(worst);
    return row;
}

}  // namespace

std::string accuracy_json(const AccuracyReport& report, const Study& study) {
    const Reference& r = report.reference;
    const ExplicitLimit& e = report.explicit_limit;
    const int within = report.fastest_within(kShareOfScatter);
    Json all{{"kind", "accuracy"},
             {"title", study.title},
             {"headline", accuracy_headline(report)},
             {"share_of_scatter", kShareOfScatter},
             {"change_of_feature", kChangeOfFeature},
             {"fastest_within_share",
              within < 0 ? Json(nullptr)
                         : Json(report.settings[static_cast<std::size_t>(within)].setting.text())},
             {"gearboxes", report.gearboxes},
             {"signal_meshes", report.signal_meshes},
             {"span_meshes", report.span_meshes},
             {"mesh_frequency_Hz", report.mesh_frequency_Hz},
             {"noise_levels", report.noise_levels},
             {"own", report.settings[static_cast<std::size_t>(report.own)].setting.text()},
             {"step_costs", report.step_costs},
             {"left_out", report.left_out},
             {"reference",
              {{"first", r.first.text()},
               {"first_order", r.first_order},
               {"second", r.second.text()},
               {"second_order", r.second_order},
               {"agreement", errors(report, r.agreement)},
               {"reached", r.reached}}},
             {"explicit_limit",
              {{"steps", e.steps},
               {"step_s", e.step_s},
               {"mesh_s", e.mesh_s()},
               {"gearbox_s", e.integration_s()},
               {"refused", e.refused}}}};
    for (const SettingResult& setting : report.settings) {
        all["settings"].push_back(setting_json(report, setting));
    }
    for (const ChoiceCheck& check : report.choices) {
        all["choices"].push_back(choice_json(report, check));
    }
    for (const MeasuredEffect& effect : report.effects) {
        all["effects"].push_back(effect_json(report, effect));
    }
    const StabilityMap& map = report.stability;
    all["stability"] = {{"stiffness_factors", map.factors},
                        {"implicit", map.implicit},
                        {"own", map.own},
                        {"own_steps", map.own_steps},
                        {"most_explicit_steps", lockstep::kMostExplicitSteps},
                        {"curves", Json::array()}};
    for (const StabilityCurve& curve : map.curves) {
        all["stability"]["curves"].push_back(
            {{"integrator", curve.integrator}, {"steps", curve.steps}});
    }
    for (const HardCase& one : map.hard) {
        all["stability"]["hard_cases"].push_back({{"name", one.name}, {"steps", one.steps}});
    }
    for (const PeerResult& peer : report.peers) {
        all["peers"].push_back(peer_json(peer));
    }
    for (const auto& [name, value] : provenance(study, 1, 1)) {
        all["provenance"][name] = value;
    }
    return json_text(all, 2) + "\n";
}

}  // namespace gearpod::mc
