#include <fmt/format.h>

#include "features/feature.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/sensor_signal.hpp"
#include "signals/noise/coloured_noise.hpp"

namespace gearpod::mc {
namespace {

// Rejects a shaft that the gearbox does not have, or that stands still.
void check_shaft(StudyDraft& draft, const char* key, std::size_t number, Member shaft) {
    const Study& study = draft.study;
    const GearboxKind kind = study.gearbox.kind;
    const std::string_view name = member_name(shaft);
    if (draft.usable("gearbox.kind") && !has_shaft(kind, shaft)) {
        draft.reject(
            key,
            fmt::format("number {}: this kind of gearbox has no {} (gearbox.kind)", number, name),
            use_shafts_text(kind));
    } else if (kind != GearboxKind::fixed_shaft && draft.usable("operation.fixed") &&
               shaft == study.operation.fixed) {
        draft.reject(key,
                     fmt::format("number {}: the {} stands still (operation.fixed)", number, name),
                     "use another shaft");
    }
}

// Rejects a list unless it has one value for each of another key's values.
void require_count(StudyDraft& draft, const char* key, const std::string& what, std::size_t count,
                   std::size_t of, const char* other) {
    if (count != of) {
        draft.reject(key, fmt::format("{}has {} values, but {} has {}", what, count, other, of),
                     "give one for each");
    }
}

// The same if both keys have been read without problems.
void check_count(StudyDraft& draft, const char* key, const std::string& what, std::size_t count,
                 std::size_t of, const char* other) {
    if (draft.all_usable({key, other})) {
        require_count(draft, key, what, count, of, other);
    }
}

// A background that begins above this multiple of a low-pass does not pass it.
constexpr double kMostPassed = 10.0;

void check_background(StudyDraft& draft) {
    const Sensor& s = draft.study.sensor;
    constexpr const char* kDensity = "sensor.background_density_m_s2_per_sqrt_Hz";
    constexpr double kNarrowest = 1000.0;
    if (s.background_Hz.empty() || !draft.all_usable({"sensor.background_Hz", kDensity})) {
        return;
    }
    if (s.background_Hz.size() < 2) {
        draft.reject("sensor.background_Hz", "has one frequency, but a spectrum needs two",
                     "give the lowest and the highest");
    } else if (s.background_density_m_s2_per_sqrt_Hz.size() != s.background_Hz.size()) {
        check_count(draft, kDensity, "", s.background_density_m_s2_per_sqrt_Hz.size(),
                    s.background_Hz.size(), "sensor.background_Hz");
    } else if (draft.all_usable({"sensor.sampling_Hz", "sensor.low_pass_Hz"}) &&
               s.background_Hz.back() - s.background_Hz.front() < s.sampling_Hz / kNarrowest) {
        draft.reject("sensor.background_Hz",
                     fmt::format("spans {:g} Hz, which is less than sampling_Hz / {:g} (the "
                                 "resolution of the background)",
                                 s.background_Hz.back() - s.background_Hz.front(), kNarrowest),
                     "use a tone (sensor.tones)");
    } else if (draft.usable("sensor.low_pass_Hz") &&
               s.background_Hz.front() >= kMostPassed * s.low_pass_Hz) {
        draft.reject("sensor.background_Hz",
                     fmt::format("begins at {:g} Hz, where low_pass_Hz passes nothing",
                                 s.background_Hz.front()),
                     "remove the background");
    }
}

void check_tones_and_bearings(StudyDraft& draft) {
    const Sensor& s = draft.study.sensor;
    for (std::size_t i = 0; i < s.tones.size() && draft.usable("sensor.tones"); ++i) {
        if (s.tones[i].shaft) {
            check_shaft(draft, "sensor.tones", i + 1, *s.tones[i].shaft);
        } else if (draft.usable("sensor.sampling_Hz") &&
                   s.tones[i].frequency_Hz >= 0.5 * s.sampling_Hz) {
            draft.reject("sensor.tones",
                         fmt::format("tone {}: {} Hz must be below {} Hz, half of sampling_Hz",
                                     i + 1, s.tones[i].frequency_Hz, 0.5 * s.sampling_Hz),
                         "lower its frequency or raise sampling_Hz");
        }
    }
    for (std::size_t i = 0; i < s.bearings.size() && draft.usable("sensor.bearings"); ++i) {
        if (s.bearings[i].shaft) {
            check_shaft(draft, "sensor.bearings", i + 1, *s.bearings[i].shaft);
        } else if (draft.usable("sensor.sampling_Hz") && s.sampling_Hz > 0.0 &&
                   impulses_per_turn(s.bearings[i]) * s.bearings[i].shaft_Hz >=
                       0.5 * s.sampling_Hz) {
            draft.reject(
                "sensor.bearings",
                fmt::format("bearing {}: {:.4g} impulses per second are not below half of "
                            "sampling_Hz, {} Hz",
                            i + 1, impulses_per_turn(s.bearings[i]) * s.bearings[i].shaft_Hz,
                            0.5 * s.sampling_Hz),
                "lower shaft_Hz");
        }
    }
    if (!s.additional.empty() && draft.study.ensemble.uses_importance_sampling() &&
        draft.usable("ensemble.threshold_tilt")) {
        draft.reject("sensor.additional",
                     "importance sampling (ensemble.threshold_tilt, or `misses`) applies to the "
                     "noise of one "
                     "sensor only",
                     "remove them");
    }
    if (has_other_sources(draft.study) && draft.study.ensemble.threshold_records > 1 &&
        draft.usable("ensemble.threshold_records")) {
        draft.reject(
            "ensemble.threshold_records",
            fmt::format("is {}, but all records of a gearbox would have the same vibration "
                        "of other sources (sensor.bearings, sensor.stages)",
                        draft.study.ensemble.threshold_records),
            "use 1, or remove bearings and stages");
    }
}

// Rejects what uses the force in a bearing that the model does not have. `key` and `which` name the
// place of the statement.
void check_bearing(StudyDraft& draft, const char* key, const std::string& which,
                   const HousingBearing& bearing) {
    const Study& study = draft.study;
    const std::string_view shaft = member_name(bearing.shaft);
    if (!draft.all_usable({"gearbox.kind", "effects.motion"})) {
        return;
    }
    if (study.gearbox.kind != GearboxKind::planetary) {
        draft.reject(key,
                     fmt::format("{}needs a {}, which this kind of gearbox does not have "
                                 "(gearbox.kind)",
                                 which, shaft),
                     "remove it");
    } else if (study.effects.torsional()) {
        draft.reject(key,
                     fmt::format("{}needs the force in the bearing of the {}, which is rigid in "
                                 "this model (effects.motion)",
                                 which, shaft),
                     "remove it, or use \"translational-torsional\"");
    } else if (const MemberValues& values = study.gearbox.bodies[bearing.shaft];
               values.bearing_stiffness_N_m == 0.0 && values.bearing_damping_N_s_m == 0.0) {
        draft.reject(key,
                     fmt::format("{}needs the force in the bearing of the {}, which has neither "
                                 "stiffness nor damping (gearbox.{}.bearing_stiffness_N_m)",
                                 which, shaft, shaft),
                     "remove it");
    }
}

// Checks what a sensor of its own states about a bearing; `which` names it.
void check_own_bearing(StudyDraft& draft, const std::string& which, const AdditionalSensor& own,
                       const HousingBearing& bearing) {
    constexpr const char* kAdditional = "sensor.additional";
    const Sensor& s = draft.study.sensor;
    const auto check = [&](const char* field, const std::vector<double>& values, std::size_t of,
                           const char* other) {
        const std::string what = fmt::format("{}: {} ", which, field);
        require_count(draft, kAdditional, what, values.size(), of, other);
        check_bearing(draft, kAdditional, what, bearing);
    };
    if (!(own.*bearing.own_per_kg).empty()) {
        check(bearing.per_kg_name, own.*bearing.own_per_kg, s.housing_modes.size(),
              "sensor.housing_modes");
    }
    if (!(own.*bearing.own_gain).empty() || !(own.*bearing.own_phase_deg).empty()) {
        check(bearing.gain_name, own.*bearing.own_gain, s.response_Hz.size(), "sensor.response_Hz");
        check(bearing.phase_name, own.*bearing.own_phase_deg, s.response_Hz.size(),
              "sensor.response_Hz");
    }
}

// Checks the responses to the forces in bearings, of the modes and of all sensors. The lists of
// modes and of additional sensors must have been read without problems.
void check_bearings_of_housing(StudyDraft& draft, bool modes_usable, bool sensors_usable) {
    const Sensor& s = draft.study.sensor;
    for (const HousingBearing& bearing : kHousingBearings) {
        for (std::size_t i = 0; i < s.housing_modes.size() && modes_usable; ++i) {
            if (s.housing_modes[i].*bearing.per_kg != 0.0) {
                check_bearing(draft, "sensor.housing_modes",
                              fmt::format("mode {}: {} ", i + 1, bearing.per_kg_name), bearing);
            }
        }
        const std::string gain = fmt::format("sensor.{}", bearing.gain_name),
                          phase = fmt::format("sensor.{}", bearing.phase_name);
        if (!(s.*bearing.gain).empty() && draft.usable(gain)) {
            check_count(draft, gain.c_str(), "", (s.*bearing.gain).size(), s.response_Hz.size(),
                        "sensor.response_Hz");
            check_count(draft, phase.c_str(), "", (s.*bearing.phase_rad).size(),
                        s.response_Hz.size(), "sensor.response_Hz");
            check_bearing(draft, gain.c_str(), "", bearing);
        }
        for (std::size_t i = 0; i < s.additional.size() && sensors_usable; ++i) {
            check_own_bearing(draft, fmt::format("sensor {}", i + 1), s.additional[i], bearing);
        }
    }
}

void check_housing(StudyDraft& draft) {
    constexpr const char *kModes = "sensor.housing_modes", *kFrequencies = "sensor.response_Hz",
                         *kAdditional = "sensor.additional";
    const Sensor& s = draft.study.sensor;
    for (std::size_t i = 0; i < s.housing_modes.size() && draft.usable(kModes); ++i) {
        if (s.housing_modes[i].nodal_diameters && draft.usable("gearbox.kind") &&
            draft.study.gearbox.kind == GearboxKind::fixed_shaft) {
            draft.reject(kModes,
                         fmt::format("mode {}: nodal_diameters are those of a ring, which this "
                                     "kind of gearbox does not have (gearbox.kind)",
                                     i + 1),
                         "remove them");
        }
    }
    if (!s.response_Hz.empty()) {
        if (s.response_Hz.size() < 2 && draft.usable(kFrequencies)) {
            draft.reject(kFrequencies, "has one frequency, but nothing passes outside of a range",
                         "give the lowest and the highest");
        }
        check_count(draft, "sensor.response_gain", "", s.response_gain.size(), s.response_Hz.size(),
                    kFrequencies);
        check_count(draft, "sensor.response_phase_deg", "", s.response_phase_rad.size(),
                    s.response_Hz.size(), kFrequencies);
    }
    for (std::size_t i = 0; i < s.additional.size(); ++i) {
        const AdditionalSensor& one = s.additional[i];
        const auto check = [&](const char* field, std::size_t count, std::size_t of,
                               const char* other) {
            check_count(draft, kAdditional, fmt::format("sensor {}: {} ", i + 1, field), count, of,
                        other);
        };
        if (!one.participation.empty()) {
            check("participation", one.participation.size(), s.housing_modes.size(), kModes);
        }
        if (!one.response_gain.empty() || !one.response_phase_deg.empty()) {
            check("response_gain", one.response_gain.size(), s.response_Hz.size(), kFrequencies);
            check("response_phase_deg", one.response_phase_deg.size(), s.response_Hz.size(),
                  kFrequencies);
        }
    }
}

void check_own_low_pass(StudyDraft& draft, std::size_t number, double low_pass_Hz) {
    constexpr const char* kAdditional = "sensor.additional";
    const Sensor& s = draft.study.sensor;
    if (!draft.all_usable({kAdditional, "sensor.low_pass_Hz"})) {
        return;
    }
    const auto reject = [&](const std::string& what, const char* remedy) {
        draft.reject(kAdditional,
                     fmt::format("sensor {}: low_pass_Hz = {} Hz {}", number, low_pass_Hz, what),
                     remedy);
    };
    if (low_pass_Hz > s.low_pass_Hz) {
        reject(fmt::format("is above sensor.low_pass_Hz, {} Hz, which the vibration of all sensors "
                           "passes first",
                           s.low_pass_Hz),
               "lower it, or make the sensor with the highest low-pass the first one");
        return;
    }
    if (!s.background_Hz.empty() && draft.usable("sensor.background_Hz") &&
        s.background_Hz.front() >= kMostPassed * low_pass_Hz) {
        reject(fmt::format("passes nothing of the background, which begins at {:g} Hz "
                           "(sensor.background_Hz)",
                           s.background_Hz.front()),
               "raise it, or remove the background");
    }
    const double finest_Hz = low_pass_Hz / signals::LowPassNoise::kLeast;
    if (s.noise_density_m_s2_per_sqrt_Hz && draft.usable("sensor.sampling_Hz") &&
        s.sampling_Hz > finest_Hz) {
        reject(
            fmt::format("is too low for sensor.sampling_Hz, {} Hz, which is above {:g} Hz (noise "
                        "samples are then too strongly correlated to be generated)",
                        s.sampling_Hz, finest_Hz),
            "raise it, or give sensor.noise_m_s2 instead of the density");
    }
}

void check_own_rate(StudyDraft& draft, std::size_t number, const AdditionalSensor& sensor) {
    constexpr const char* kAdditional = "sensor.additional";
    const Sensor& s = draft.study.sensor;
    const double rate_Hz = *sensor.sampling_Hz;
    if (!draft.all_usable({kAdditional, "sensor.low_pass_Hz", "sensor.sampling_Hz"})) {
        return;
    }
    const auto reject = [&](const std::string& what, const char* remedy) {
        draft.reject(kAdditional,
                     fmt::format("sensor {}: sampling_Hz = {} Hz {}", number, rate_Hz, what),
                     remedy);
    };
    const double low_pass_Hz = sensor.low_pass_Hz.value_or(s.low_pass_Hz);
    if (rate_Hz > s.sampling_Hz) {
        reject(fmt::format("is above sensor.sampling_Hz, {} Hz, with which all vibration is "
                           "computed",
                           s.sampling_Hz),
               "lower it, or make the sensor with the highest rate the first one");
    } else if (low_pass_Hz >= 0.5 * rate_Hz) {
        reject(fmt::format("is not above twice its low-pass, {} Hz (higher frequencies would "
                           "alias)",
                           low_pass_Hz),
               "raise it, or give the sensor a lower low_pass_Hz");
    }
}

// A measuring range clips samples with their noise. What works with noise that adds to the signal
// is rejected.
void check_range(StudyDraft& draft) {
    const Study& study = draft.study;
    if (!has_range(study) || !draft.all_usable({"sensor.range_m_s2", "sensor.additional"})) {
        return;
    }
    const char* key = study.sensor.range_m_s2 ? "sensor.range_m_s2" : "sensor.additional";
    for (const std::string& name : study.features.use) {
        const features::Feature* feature = find_feature(study, name);
        const bool of_change = feature != nullptr && (feature->from_sensor || feature->external) &&
                               (feature->baseline_use == features::BaselineUse::change ||
                                feature->baseline_use == features::BaselineUse::record_and_change);
        if (of_change && draft.usable("features.use")) {
            draft.reject(
                key,
                fmt::format("a range clips the samples, but \"{}\" (features.use) subtracts "
                            "the baseline from samples that are not clipped",
                            name),
                "remove the feature or the range (range_m_s2)");
        }
    }
    if (study.ensemble.uses_importance_sampling() && draft.usable("ensemble.threshold_tilt")) {
        draft.reject(key,
                     "a range clips the samples, but importance sampling "
                     "(ensemble.threshold_tilt, or `misses`) needs Gaussian noise",
                     "remove the range (range_m_s2)");
    }
}

}  // namespace

void check_sampling(StudyDraft& draft) {
    const Sensor& s = draft.study.sensor;
    check_background(draft);
    const bool modes_usable = draft.usable("sensor.housing_modes"),
               sensors_usable = draft.usable("sensor.additional") &&
                                draft.all_usable({"sensor.housing_modes", "sensor.response_Hz"});
    check_housing(draft);
    check_bearings_of_housing(draft, modes_usable, sensors_usable);
    check_tones_and_bearings(draft);
    check_range(draft);
    for (std::size_t i = 0; i < s.additional.size(); ++i) {
        if (s.additional[i].low_pass_Hz) {
            check_own_low_pass(draft, i + 1, *s.additional[i].low_pass_Hz);
        }
        if (s.additional[i].sampling_Hz) {
            check_own_rate(draft, i + 1, s.additional[i]);
        }
    }
    if (draft.study.effects.quasi_static() || !draft.all_usable({"sensor.sampling_Hz"}) ||
        s.sampling_Hz <= 0.0) {
        return;
    }
    if (draft.all_usable({"sensor.low_pass_Hz"}) && s.low_pass_Hz >= 0.5 * s.sampling_Hz) {
        draft.reject(
            "sensor.low_pass_Hz",
            fmt::format(
                "{} Hz must be below {} Hz, half of sampling_Hz (higher frequencies would alias)",
                s.low_pass_Hz, 0.5 * s.sampling_Hz),
            "lower low_pass_Hz or raise sampling_Hz");
    }
    const double finest_Hz = s.low_pass_Hz / signals::LowPassNoise::kLeast;
    if (s.noise_density_m_s2_per_sqrt_Hz && draft.all_usable({"sensor.low_pass_Hz"}) &&
        s.sampling_Hz > finest_Hz) {
        draft.reject("sensor.sampling_Hz",
                     fmt::format("{} Hz is above {:g} Hz (after a low-pass of {} Hz, noise samples "
                                 "are then too strongly correlated to be generated)",
                                 s.sampling_Hz, finest_Hz, s.low_pass_Hz),
                     "lower it, or give sensor.noise_m_s2 instead of the density");
    }
    if (draft.all_usable({"sensor.encoder_sampling_Hz"}) && s.encoder_sampling_Hz > s.sampling_Hz) {
        draft.reject("sensor.encoder_sampling_Hz",
                     fmt::format("{} Hz is above sampling_Hz, {} Hz (the encoders are read at some "
                                 "of the sensor's samples)",
                                 s.encoder_sampling_Hz, s.sampling_Hz),
                     "lower encoder_sampling_Hz or raise sampling_Hz");
    }
}

}  // namespace gearpod::mc
