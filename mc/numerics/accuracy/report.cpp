// accuracy_text(): writes an accuracy report as text.
#include "mc/numerics/accuracy/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/report/json_values.hpp"
#include "lockstep/steps/stability.hpp"
#include "machine/no_value.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/text/text_table.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::mc {
namespace {

using Text = std::back_insert_iterator<std::string>;

std::string short_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.1e}", value) : "-";
}

std::string worst_feature(const AccuracyReport& report, const PilotError& error) {
    return report.features[static_cast<std::size_t>(error.worst_feature(report.levels()))];
}

// Time of an integration, with a unit that keeps it readable.
std::string time_text(double seconds) {
    return seconds < 1e-3 ? fmt::format("{:.3g} us", 1e6 * seconds)
           : seconds < 1  ? fmt::format("{:.3g} ms", 1e3 * seconds)
                          : fmt::format("{:.3g} s", seconds);
}

// Adds indented lines that fit kLineWidth.
void add_words(const std::string& words, std::size_t indent, Text out) {
    fmt::format_to(out, "{}{}\n", std::string(indent, ' '), wrapped_text(words, indent));
}

void add_head(const AccuracyReport& report, Text out) {
    const Reference& r = report.reference;
    fmt::format_to(
        out,
        "pilot: {} gearboxes, mesh periods in signals: {}, in features: {}\n"
        "reference: {}{}\n"
        "compared with: {}{}\n"
        "  relative L2 {:.1e} (sensor), {:.1e} (TE), worst feature {:.1e}{}\n",
        report.gearboxes, report.signal_meshes, report.span_meshes, r.first.text(),
        r.first_order > 0 ? fmt::format("\n  extrapolated at order {:g}", r.first_order) : "",
        r.second.text(),
        r.second_order > 0 ? fmt::format("\n  extrapolated at order {:g}", r.second_order) : "",
        r.agreement.sensor, r.agreement.te, r.agreement.largest_feature(),
        r.reached ? "" : "\n  the signals do not agree to 1e-8");
}

void add_heading(Text out) {
    fmt::format_to(
        out,
        "\ntime: processor time of one gearbox of eight that are integrated together\n"
        "(sixteen in single precision), time integration only; error: relative L2 of the "
        "noise-free\n"
        "sensor signal and of the transmission error (TE) without its mean; feature: the\n"
        "worst one, rms over the gearboxes; *: Pareto frontier of time and error\n\n"
        "solver setting\n"
        "{:>7} {:>6} {:>8} {:>10} {:>7} {:>7} {:>7}  {}\n",
        "steps", "meshes", "us/mesh", "us/gearbox", "sensor", "TE", "feature", "worst");
}

void add_row(const AccuracyReport& report, const SettingResult& r, const char* mark, Text out) {
    if (!r.refusal.empty()) {
        fmt::format_to(out, "{}{}\n", mark, r.setting.integrator());
        add_words("not possible: " + r.refusal, 4, out);
        return;
    }
    add_words(
        mark + r.setting.text() + (r.failed > 0 ? fmt::format(" ({:g} failed)", r.failed) : ""), 0,
        out);
    fmt::format_to(out, "{:>7} {:>6.0f} {:>8.2f} {:>10.1f} {:>7} {:>7} {:>7}  {}\n", r.steps,
                   r.meshes, 1e6 * r.mesh_s, 1e6 * r.integration_s, short_number(r.error.sensor),
                   short_number(r.error.te), short_number(r.error.largest_feature()),
                   worst_feature(report, r.error));
}

// True for settings that are listed: those of each family with the tightest convergence tolerance,
// those with fewer terms in the stiffness curves, the frontier, the chosen ones and the study's
// own.
bool is_listed(const AccuracyReport& report, std::size_t i) {
    const SettingResult& r = report.settings[i];
    return r.frontier || static_cast<int>(i) == report.own ||
           (!r.refusal.empty() && r.refusal != kNotTried) ||
           r.setting.numerics.convergence_tolerance <= 1e-10 ||
           r.setting.chooses("stiffness_tolerance") ||
           std::any_of(report.choices.begin(), report.choices.end(),
                       [&](const ChoiceCheck& c) { return c.chosen == static_cast<int>(i); });
}

void add_explicit_limit(const AccuracyReport& report, Text out) {
    const ExplicitLimit& e = report.explicit_limit;
    fmt::format_to(out, "\n");
    add_words(fmt::format("rk4 at its stability limit ({}): {:.0f} steps of {:.1f} ns (measured) = "
                          "{:.3g} us/mesh, x {:.0f} meshes = {:.3g} us/gearbox",
                          e.refused ? "refused; computed" : "computed", e.steps, 1e9 * e.step_s,
                          1e6 * e.mesh_s(), e.meshes, 1e6 * e.integration_s()),
              0, out);
}

std::size_t column_width(const StabilityCurve& curve) {
    return std::max<std::size_t>(8, curve.integrator.size());
}

// Every third factor of the map: a tenth, the study's own stiffness, ten times.
void add_stability(const StabilityMap& map, Text out) {
    fmt::format_to(out,
                   "\nfewest stable steps per mesh period, by the stiffness of the meshes\n"
                   "{:<20}",
                   "");
    for (std::size_t i = 0; i < map.factors.size(); i += 3) {
        fmt::format_to(out, "{:>11}", fmt::format("x {:g}", map.factors[i]));
    }
    for (const StabilityCurve& curve : map.curves) {
        fmt::format_to(out, "\n{:<20}", curve.integrator);
        for (std::size_t i = 0; i < map.factors.size(); i += 3) {
            fmt::format_to(out, "{:>11.0f}", curve.steps[i]);
        }
    }
    fmt::format_to(out, "\n\n{:<40}", "the same in hard cases");
    for (const StabilityCurve& curve : map.curves) {
        fmt::format_to(out, " {:>{}}", curve.integrator, column_width(curve));
    }
    for (const HardCase& one : map.hard) {
        fmt::format_to(out, "\n{:<40}", one.name);
        for (std::size_t i = 0; i < one.steps.size(); ++i) {
            fmt::format_to(out, " {:>{}.0f}", one.steps[i], column_width(map.curves[i]));
        }
    }
    fmt::format_to(out, "\n");
    add_words(fmt::format("without mass scaling; above {:.0f} explicit integrators are refused; {} "
                          "are stable with any steps",
                          lockstep::kMostExplicitSteps, fmt::join(map.implicit, ", ")),
              0, out);
}

void add_choices(const AccuracyReport& report, Text out) {
    fmt::format_to(out, "\nnumerics.tolerance\n");
    for (const ChoiceCheck& c : report.choices) {
        if (c.chosen < 0) {
            add_words(fmt::format("{:g}: no choice: {}", c.tolerance, c.refusal), 2, out);
            continue;
        }
        const SettingResult& chosen = report.settings[static_cast<std::size_t>(c.chosen)];
        add_words(fmt::format("{:g}: {}, worst feature {:.1e}, {:.1f} us/gearbox", c.tolerance,
                              chosen.setting.text(), chosen.error.largest_feature(),
                              1e6 * chosen.integration_s),
                  2, out);
        std::string comparison;
        if (c.best >= 0) {
            const SettingResult& best = report.settings[static_cast<std::size_t>(c.best)];
            comparison = fmt::format("{:+.0f} % against the fastest setting that keeps it ({}); ",
                                     100.0 * c.over_best, best.setting.text());
        }
        comparison += fmt::format(
            "1/{:.3g} of rk4's time at its limit per mesh period, 1/{:.3g} "
            "per gearbox",
            report.explicit_limit.mesh_s() / chosen.mesh_s,
            report.explicit_limit.integration_s() / chosen.integration_s);
        add_words(comparison, 4, out);
    }
    if (!report.step_costs.empty()) {
        add_words(
            fmt::format("time of a step relative to rk4's: {}", fmt::join(report.step_costs, "; ")),
            2, out);
    }
}

void add_features(const AccuracyReport& report, Text out) {
    fmt::format_to(out, "\nrelative errors of the features on the frontier\n");
    for (const SettingResult& r : report.settings) {
        if (!r.frontier) {
            continue;
        }
        fmt::format_to(out, "{}\n", r.setting.text());
        std::string errors;
        for (std::size_t f = 0; f < report.features.size(); ++f) {
            errors +=
                fmt::format("{}{}={}", errors.empty() ? "" : ", ", report.features[f],
                            short_number(r.error.feature(static_cast<int>(f), report.levels())));
        }
        add_words(errors, 4, out);
    }
}

std::string sizes_text(const DetectionChange& d) {
    if (d.a90 < 0.0) {
        return "no a90";
    }
    return fmt::format("{:.2f} %{}", 100.0 * d.a90,
                       std::isfinite(d.a90_interval)
                           ? fmt::format(" (interval {:.1f} %)", 100.0 * d.a90_interval)
                           : "");
}

void add_detection(const AccuracyReport& report, Text out) {
    const auto detected = [](const SettingResult& r) { return r.detection.has_value(); };
    const auto first = std::find_if(report.settings.begin(), report.settings.end(), detected);
    if (first == report.settings.end()) {
        return;
    }
    fmt::format_to(out,
                   "\ndetection: the same {} test gearboxes with the most accurate setting and\n"
                   "with these; largest change over features, sizes and noise levels\n"
                   "error/scatter: largest error of a feature over its standard deviation\n"
                   "between healthy gearboxes\n"
                   "{:>16} {:>22} {:>14}  {}\n",
                   first->detection->gearboxes, "alarms changed", "Pd (half width)",
                   "error/scatter", "a90");
    for (const SettingResult& r : report.settings) {
        if (!r.detection) {
            continue;
        }
        const DetectionChange& d = *r.detection;
        fmt::format_to(out, "{}\n{:>14.3f} % {:>22} {:>14}  {}\n", r.setting.text(),
                       100.0 * d.alarms, fmt::format("{:.4f} ({:.3f})", d.pd, d.pd_half_width),
                       short_number(report.largest_share_of_scatter(r.error)), sizes_text(d));
    }
}

void add_effects(const AccuracyReport& report, Text out) {
    if (report.effects.empty()) {
        return;
    }
    fmt::format_to(out, "\n");
    add_words(fmt::format(
                  "cost of effects: the pilot without an effect of the study, or with one that it "
                  "leaves out. time: of a gearbox with it over that without; change: of the "
                  "sensor signal, and of the feature that changes most; needed: it changes a "
                  "feature by more than {:g} of its scatter between healthy gearboxes, or by {:g} "
                  "of its value where the scatter was not measured",
                  kShareOfScatter, kChangeOfFeature),
              0, out);
    fmt::format_to(out, "{:<24} {:<8} {:>5} {:>8} {:>8} {:>9}  {:<10} {}\n", "effect", "in study",
                   "time", "sensor", "feature", "/scatter", "needed", "most");
    for (const MeasuredEffect& e : report.effects) {
        fmt::format_to(out, "{:<24} {:<8} ", e.effect, e.in_study ? "yes" : "no");
        if (!e.refusal.empty()) {
            fmt::format_to(out, "not possible\n");
            add_words(e.refusal, 4, out);
            continue;
        }
        fmt::format_to(out, "{:>5.2f} {:>8} {:>8} {:>9}  {:<10} {}\n", e.time_ratio,
                       short_number(e.change.sensor), short_number(e.change.largest_feature()),
                       short_number(report.largest_share_of_scatter(e.change)),
                       report.matters(e.change) ? "yes" : "no", worst_feature(report, e.change));
    }
}

void add_left_out(const AccuracyReport& report, Text out) {
    if (!report.left_out.empty()) {
        fmt::format_to(out, "\nomitted because the time had run out (--seconds 0: no limit)\n");
        for (const std::string& what : report.left_out) {
            add_words(what, 2, out);
        }
    }
}

void add_peers(const AccuracyReport& report, Text out) {
    for (const PeerResult& p : report.peers) {
        fmt::format_to(out, "  {}\n{:>7} {:>6} {:>8.3g} {:>10.3g} {:>7} {:>7} ", p.name, "", "",
                       1e6 * p.mesh_s, 1e6 * p.integration_s, short_number(p.sensor),
                       short_number(p.te));
        const auto worst =
            std::max_element(p.features.begin(), p.features.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        if (worst == p.features.end()) {
            fmt::format_to(out, "{:>7}\n", "-");
        } else {
            fmt::format_to(out, "{:>7}  {}\n", short_number(worst->second), worst->first);
        }
    }
}

}  // namespace

double AccuracyReport::share_of_scatter(const PilotError& error, int f) const {
    double largest = kNan;
    for (int level = 0; level < levels(); ++level) {
        const auto at = static_cast<std::size_t>(f * levels() + level);
        if (at < scatter.size() && at < error.rms.size() && scatter[at] > 0.0) {
            largest = std::fmax(largest, error.rms[at] / scatter[at]);
        }
    }
    return largest;
}

double AccuracyReport::largest_share_of_scatter(const PilotError& error) const {
    double largest = kNan;
    for (int f = 0; f < static_cast<int>(features.size()); ++f) {
        largest = std::fmax(largest, share_of_scatter(error, f));
    }
    return largest;
}

bool AccuracyReport::matters(const PilotError& change) const {
    const double share = largest_share_of_scatter(change);
    return std::isfinite(share) ? share > kShareOfScatter
                                : !(change.largest_feature() <= kChangeOfFeature);
}

int AccuracyReport::fastest_within(double share) const {
    int fastest = -1;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const SettingResult& r = settings[i];
        if (r.refusal.empty() && r.failed == 0.0 && largest_share_of_scatter(r.error) <= share &&
            (fastest < 0 ||
             r.integration_s < settings[static_cast<std::size_t>(fastest)].integration_s)) {
            fastest = static_cast<int>(i);
        }
    }
    return fastest;
}

std::string accuracy_headline(const AccuracyReport& report) {
    const SettingResult& own = report.settings[static_cast<std::size_t>(report.own)];
    if (!own.refusal.empty()) {
        return fmt::format("The study's own setting, {}, was not measured: {}.", own.setting.text(),
                           own.refusal);
    }
    std::string text = fmt::format(
        "The study's own setting, {}, takes {} of integration per gearbox; its worst feature, {}, "
        "has an error of {:.1e} of its value",
        own.setting.text(), time_text(own.integration_s), worst_feature(report, own.error),
        own.error.largest_feature());
    if (report.scatter.empty()) {
        return text + ". How this compares with the scatter between gearboxes was not measured.";
    }
    text += fmt::format(
        ", and no error exceeds {:.1e} of a feature's scatter between healthy gearboxes.",
        report.largest_share_of_scatter(own.error));
    const int fastest = report.fastest_within(kShareOfScatter);
    if (fastest < 0) {
        return text + fmt::format(" No measured setting keeps all errors within {:g} of it.",
                                  kShareOfScatter);
    }
    const SettingResult& r = report.settings[static_cast<std::size_t>(fastest)];
    return text + fmt::format(
                      " The fastest setting with errors within {:g} of it, which widens the "
                      "scatter by at most 2 %, is {}: {} of integration.",
                      kShareOfScatter, r.setting.text(), time_text(r.integration_s));
}

std::string accuracy_text(const AccuracyReport& report) {
    std::string text;
    Text out(text);
    add_words(accuracy_headline(report), 0, out);
    fmt::format_to(out, "\n");
    add_head(report, out);
    add_heading(out);
    for (std::size_t i = 0; i < report.settings.size(); ++i) {
        if (is_listed(report, i)) {
            add_row(report, report.settings[i], report.settings[i].frontier ? "* " : "  ", out);
        }
    }
    add_peers(report, out);
    add_explicit_limit(report, out);
    add_stability(report.stability, out);
    add_choices(report, out);
    add_features(report, out);
    add_detection(report, out);
    add_effects(report, out);
    add_left_out(report, out);
    return text;
}

// accuracy_json(): writes an accuracy report as JSON.

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
        row["detection"] = analysis::fields_json(*r.detection);
        row["detection"]["a90_change"] =
            r.detection->a90 < 0.0 ? Json(nullptr) : Json(r.detection->a90);
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
    Json row = analysis::fields_json(p);
    double worst = 0.0;
    for (const auto& [feature, error] : p.features) {
        row["features"][feature] = analysis::number(error);
        worst = std::max(worst, error);
    }
    row["worst_feature"] = p.features.empty() ? Json(nullptr) : analysis::number(worst);
    return row;
}

}  // namespace

std::string accuracy_json(const AccuracyReport& report, const EnsemblePlan& plan) {
    const Reference& r = report.reference;
    const ExplicitLimit& e = report.explicit_limit;
    const int within = report.fastest_within(kShareOfScatter);
    Json all{{"kind", "accuracy"},
             {"title", plan.title},
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
                        {"curves", analysis::json_of(map.curves)}};
    if (!map.hard.empty()) {
        all["stability"]["hard_cases"] = analysis::json_of(map.hard);
    }
    for (const PeerResult& peer : report.peers) {
        all["peers"].push_back(peer_json(peer));
    }
    for (const auto& [name, value] : provenance(plan, 1, 1)) {
        all["provenance"][name] = value;
    }
    return json_text(all, 2) + "\n";
}

std::vector<PeerResult> read_peers(const std::string& path) {
    const TextTable table = read_text_table(path);
    std::vector<std::string> names;
    for (const TableColumn& column : table.columns) {
        // The integration's time had another name in earlier versions.
        names.push_back(column.name == "march_s" ? "integration_s" : column.name);
    }
    const std::vector<std::string> first{"name",   "command", "integration_s",
                                         "mesh_s", "sensor",  "te"};
    if (names.size() < first.size() || !std::equal(first.begin(), first.end(), names.begin())) {
        throw std::runtime_error(path +
                                 ":1: must begin with name,command,integration_s,mesh_s,sensor,te");
    }
    std::vector<PeerResult> peers;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::vector<std::string>& cells = table.rows[row];
        PeerResult& peer =
            peers.emplace_back(PeerResult{cells[0], cells[1], 0.0, 0.0, 0.0, 0.0, {}});
        double* const into[] = {&peer.integration_s, &peer.mesh_s, &peer.sensor, &peer.te};
        for (std::size_t i = 2; i < cells.size(); ++i) {
            const std::optional<double> value = table.number(row, i);
            if (!value || *value < 0.0) {
                throw std::runtime_error(fmt::format("{}:{}: {}: \"{}\" is not a number >= 0", path,
                                                     table.lines[row], names[i], cells[i]));
            }
            if (i < first.size()) {
                *into[i - 2] = *value;
            } else {
                peer.features.emplace_back(names[i], *value);
            }
        }
    }
    return peers;
}

}  // namespace gearpod::mc
