#include "mc/lives/record_span.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mc/scene/feature_needs.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"

namespace gearpod::mc {
namespace {

double mesh_frequency_Hz(const Scene& scene, double speed_rad_s) {
    return std::abs(scene.drivetrain().mesh_frequency_rad_s(speed_rad_s)) /
           (2.0 * std::numbers::pi);
}

}  // namespace

RecordSpan record_span(const Scene& scene, double speed_rad_s) {
    const signals::SpanLayout& span = scene.span();
    const RecordLength length = life_record_length(scene.study());
    RecordSpan record{span.ring_teeth, span.ring_teeth, scene.study().life.recordings};
    if (length.given()) {
        const double mesh_Hz = mesh_frequency_Hz(scene, speed_rad_s);
        check_record_length(length, span, mesh_Hz);
        record.turns = whole_turns(length, span, mesh_Hz);
    }
    return record;
}

std::string record_text(const Scene& scene) {
    const double speed = nominal_inputs(scene.study()).speed_rad_s;
    const RecordSpan record = record_span(scene, speed);
    const int teeth = scene.span().planet_teeth;
    std::string text = fmt::format("{} turns of {} mesh periods, {:.3g} s", record.turns, teeth,
                                   record.turns * teeth / mesh_frequency_Hz(scene, speed));
    if (record.recordings > 1) {
        text += fmt::format(", averaged over {} such recordings", record.recordings);
    }
    return text +
           (record.turns >= record.all_turns
                ? fmt::format(": each of the {} teeth with all {} mating teeth", teeth,
                              record.all_turns)
                : fmt::format(
                      ": each of the {} teeth with {} of its {} mating teeth, chosen at random",
                      teeth, record.turns, record.all_turns));
}

std::vector<SceneError> superposition_problems(const Scene& scene) {
    const Study& study = scene.study();
    std::vector<SceneError> problems;
    const auto reject = [&](const char* key, const std::string& what, const char* remedy) {
        problems.emplace_back(key, what, remedy);
    };
    if (!study.life.interval_h) {
        reject("life.interval_h", "missing: the time between records", "add [life]");
    }
    for (const features::Feature* feature : used_features(study)) {
        const bool own = feature->baseline_use == features::BaselineUse::baseline;
        if (own || feature->external || !feature->needs.within(features::kBasicSignals)) {
            reject("features.use",
                   "\"" + std::string(feature->name) +
                       (own ? "\" compares with a baseline record, but a life has its own baseline "
                              "(monitoring.baseline_records)"
                        : feature->external
                            ? "\" is in Python, but lives compute features of the program only"
                            : "\" needs samples, but superposed records have only folded squares"),
                   "use te_..., sensor_rms, window_ratio, window_z, change_window_ratio or "
                   "change_window_z");
        }
    }
    const bool short_records = life_record_length(study).given();
    for (const std::string& name : study.features.use) {
        if (short_records && name.starts_with("te_")) {
            reject("features.use",
                   "\"" + name +
                       "\" averages the transmission error over the whole span, but recordings "
                       "have another length",
                   "remove it, or record_s and record_turns");
        }
    }
    if (study.effects.quasi_static()) {
        reject("effects.motion", "a quasi-static gearbox has no sensor signal",
               "use motion = \"translational-torsional\" or \"torsional\"");
    }
    if (study.sensor.noise_levels.size() != 1) {
        reject("sensor.noise_levels", "a life has one noise level", "use noise_levels = [1]");
    }
    if (has_random_fluctuations(study) || !study.sensor.tones.empty() ||
        !study.sensor.bearings.empty()) {
        reject("life.interval_h",
               "records are superpositions of steady signals, but the study has fluctuations, "
               "gravity, tones or bearings that differ between records",
               "remove them");
    }
    if (!study.sensor.additional.empty()) {
        reject("sensor.additional", "lives have the first sensor only", "remove them");
    }
    if (has_housing(study)) {
        reject("sensor.housing_modes",
               "records are superpositions of parts that reach the sensor along a stiff path",
               "remove them, and a measured response (sensor.response_Hz)");
    }
    if (short_records) {
        try {
            record_span(scene, nominal_inputs(study).speed_rad_s);
        } catch (const SceneError& error) {
            problems.push_back(error);
        }
    }
    return problems;
}

void check_superposable(const Scene& scene) {
    if (const auto problems = superposition_problems(scene); !problems.empty()) {
        throw problems.front();
    }
}

}  // namespace gearpod::mc
