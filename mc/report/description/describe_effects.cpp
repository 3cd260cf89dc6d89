#include "mc/report/description/describe_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "mc/numerics/measured_effects.hpp"
#include "mc/report/description/terminal_text.hpp"

namespace gearpod::mc {
namespace {

std::string percent(double change) {
    return change < 0.1 ? fmt::format("{:.2g} %", 100.0 * change)
                        : fmt::format("{:.0f} %", 100.0 * change);
}

std::string change_text(const MeasuredEffect& effect, const SolverFacts& facts, double tolerance) {
    if (!effect.refusal.empty()) {
        return "not measured: " + effect.refusal;
    }
    const int levels = static_cast<int>(facts.noise_levels.size());
    const double change = effect.change.largest_feature();
    const std::string& feature =
        facts.features[static_cast<std::size_t>(effect.change.worst_feature(levels))];
    std::string text = effect.in_study ? "simulated" : "omitted";
    if (!std::isfinite(change)) {
        text += effect.in_study ? "; without it gearboxes fail" : "; with it gearboxes fail";
    } else if (change > tolerance) {
        text += fmt::format("; {} {} by {}", effect.in_study ? "changes" : "would change", feature,
                            percent(change));
    } else {
        text +=
            fmt::format("; {} no feature by more than {:g} % (most: {} by {}){}",
                        effect.in_study ? "changes" : "would change", 100.0 * tolerance, feature,
                        percent(change), effect.in_study ? ", so the study does not need it" : "");
    }
    return text + fmt::format("; time x {:.2g}", effect.time_ratio);
}

}  // namespace

void print_effect_changes(const Planner& planner, const signals::SpanLayout& span,
                          double mesh_frequency_Hz, double seconds) {
    const SolverFacts& facts = planner.facts();
    if (facts.features.empty()) {
        return;
    }
    const double tolerance =
        facts.numerics.tolerance > 0.0 ? facts.numerics.tolerance : kChangeOfFeature;
    const Planner brief = planner.with_short_records(span, mesh_frequency_Hz);
    bool begun = false;
    const EffectMeasurement all = measure_effects(
        brief,
        {.seconds = seconds, .measured = [&](const MeasuredEffect& effect) {
             if (!begun) {
                 print_heading("what the effects change");
                 print_entry(
                     "measured on",
                     fmt::format("{} gearboxes to test, records of {}", lockstep::kPilotLanes,
                                 record_length_text(brief.tile(brief.facts().numerics).record)));
                 begun = true;
             }
             print_entry(effect.effect, change_text(effect, facts, tolerance));
         }});
    if (!all.omitted.empty()) {
        print_entry(
            "not measured",
            fmt::format(
                "{}: the time was used up (--seconds; gearpod accuracy measures all of them)",
                fmt::join(all.omitted, ", ")));
    }
}

}  // namespace gearpod::mc
