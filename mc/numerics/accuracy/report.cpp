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

void add_reference(const AccuracyReport& report, Text out) {
    const Reference& r = report.reference;
    add_words(
        fmt::format("Errors are relative to {}; {} differs from it by {:.1e} of the sensor signal, "
                    "{:.1e} of the transmission error (TE) and {:.1e} of the worst feature{}. "
                    "{} gearboxes, {} mesh periods.",
                    r.first.text(), r.second.text(), r.agreement.sensor, r.agreement.te,
                    r.agreement.largest_feature(),
                    r.reached ? "" : ": the signals do not agree to 1e-8", report.gearboxes,
                    report.signal_meshes),
        0, out);
}

void add_result(double mesh_s, double integration_s, double sensor, double te, double feature,
                const std::string& worst, const std::string& name, Text out) {
    fmt::format_to(out, "{:>10.2f} {:>10.1f} {:>7} {:>7} {:>7}  {}\n    {}\n", 1e6 * mesh_s,
                   1e6 * integration_s, short_number(sensor), short_number(te),
                   short_number(feature), worst, name);
}

// Settings that are shown: the study's own, and those than which none is both faster and more
// accurate; where these are many, as many as fit a screen, from the fastest to the most accurate.
std::vector<const SettingResult*> shown_settings(const AccuracyReport& report) {
    constexpr std::size_t kMost = 8;
    std::vector<const SettingResult*> frontier;
    for (const SettingResult& r : report.settings) {
        if (r.frontier && r.refusal.empty()) {
            frontier.push_back(&r);
        }
    }
    std::ranges::sort(frontier, {}, &SettingResult::integration_s);
    const SettingResult& own = report.settings.front();
    std::vector<const SettingResult*> shown;
    const std::size_t rows = std::min(kMost, frontier.size());
    for (std::size_t i = 0; i < rows; ++i) {
        shown.push_back(frontier[rows == 1 ? 0 : i * (frontier.size() - 1) / (rows - 1)]);
    }
    if (own.refusal.empty() && std::ranges::find(shown, &own) == shown.end()) {
        shown.push_back(&own);
    }
    return shown;
}

void add_settings(const AccuracyReport& report, Text out) {
    fmt::format_to(out, "\n{:>10} {:>10} {:>7} {:>7} {:>7}  {}\n", "us/mesh", "us/gearbox",
                   "sensor", "TE", "feature", "the worst one");
    for (const SettingResult* r : shown_settings(report)) {
        add_result(r->mesh_s, r->integration_s, r->error.sensor, r->error.te,
                   r->error.largest_feature(), worst_feature(report, r->error), r->setting.text(),
                   out);
    }
    for (const PeerResult& p : report.peers) {
        const auto worst = std::ranges::max_element(
            p.features, {}, [](const auto& feature) { return feature.second; });
        const bool any = worst != p.features.end();
        add_result(p.mesh_s, p.integration_s, p.sensor, p.te, any ? worst->second : kNan,
                   any ? worst->first : "", p.name, out);
    }
    const ExplicitLimit& e = report.explicit_limit;
    add_words(
        fmt::format("rk4 at its stability limit, {} steps per mesh period{}, would take "
                    "{:.1f} us per gearbox.",
                    std::round(e.steps), e.refused ? " (refused)" : "", 1e6 * e.integration_s()),
        0, out);
}

void add_effects(const AccuracyReport& report, Text out) {
    std::vector<std::string> needed, idle;
    for (const MeasuredEffect& e : report.effects) {
        if (e.refusal.empty()) {
            (report.matters(e.change) ? needed : idle)
                .push_back(fmt::format("{} (time x {:.2f})", e.effect, e.time_ratio));
        }
    }
    for (const auto& [words, effects] :
         {std::pair{"Effects that change a feature", &needed}, {"Effects that do not", &idle}}) {
        if (!effects->empty()) {
            add_words(fmt::format("{}: {}.", words, fmt::join(*effects, ", ")), 0, out);
        }
    }
}

void add_left_out(const AccuracyReport& report, Text out) {
    if (!report.left_out.empty()) {
        add_words(fmt::format("Omitted because the time had run out (--seconds 0: no limit): {}.",
                              fmt::join(report.left_out, "; ")),
                  0, out);
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
    const SettingResult& own = report.settings.front();
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
    add_reference(report, out);
    add_settings(report, out);
    add_effects(report, out);
    add_left_out(report, out);
    add_words(
        "Each feature, detection rates, stability and all settings: --html FILE, --json FILE.", 0,
        out);
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
                {"gearbox_with_features_s", r.total_s},
                {"mesh_s", r.mesh_s},
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
             {"own", report.settings.front().setting.text()},
             {"left_out", report.left_out},
             {"reference",
              {{"first", r.first.text()},
               {"second", r.second.text()},
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
