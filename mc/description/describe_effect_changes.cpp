#include "mc/description/describe_effect_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "mc/description/entries.hpp"
#include "mc/gearbox/record_window.hpp"
#include "mc/numerics/choice.hpp"
#include "mc/numerics/measured_effects.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/study/fluctuations.hpp"

namespace gearpod::mc {
namespace {

// Scene with the study's own numerics, and with short records where every mesh period is integrated
// and the features allow it.
Scene short_scene(const Study& study, const Scene& chosen) {
    const Study plain = without_tolerance(study);
    if (reason_not_periodic(study).empty()) {
        return Scene(plain);
    }
    Study brief = plain;
    brief.sensor.record_turns.reset();
    // Half a mesh period more, because whole turns are taken.
    brief.sensor.record_s = (kLeastRecordTurns * chosen.span().planet_teeth + 0.5) /
                            std::abs(chosen.nominal_mesh_frequency_Hz());
    try {
        return Scene(brief);
    } catch (const SceneError&) {
        return Scene(plain);
    }
}

std::string percent(double change) {
    return change < 0.1 ? fmt::format("{:.2g} %", 100.0 * change)
                        : fmt::format("{:.0f} %", 100.0 * change);
}

std::string change_text(const MeasuredEffect& effect, const Study& study, double tolerance) {
    if (!effect.refusal.empty()) {
        return "not measured: " + effect.refusal;
    }
    const int levels = static_cast<int>(study.sensor.noise_levels.size());
    const double change = effect.change.largest_feature();
    const std::string& feature =
        study.features.use[static_cast<std::size_t>(effect.change.worst_feature(levels))];
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

void print_effect_changes(const Study& study, const Scene& chosen, double seconds) {
    if (study.features.use.empty()) {
        return;
    }
    const double tolerance =
        study.numerics.tolerance > 0.0 ? study.numerics.tolerance : kChangeOfFeature;
    const Scene scene = short_scene(study, chosen);
    bool begun = false;
    const EffectMeasurement all = measure_effects(
        scene, {.seconds = seconds, .measured = [&](const MeasuredEffect& one) {
                    if (!begun) {
                        print_heading("what the effects change");
                        print_entry("measured on",
                                    fmt::format("{} gearboxes to test, records of {}",
                                                lockstep::kPilotLanes, record_length_text(scene)));
                        begun = true;
                    }
                    print_entry(one.effect, change_text(one, study, tolerance));
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
