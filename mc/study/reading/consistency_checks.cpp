#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/monitoring/detector.hpp"
#include "features/feature.hpp"
#include "mc/files/input/spelling.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "signals/windowing/noise_importance_sampler.hpp"

namespace gearpod::mc {
namespace {

// Quoted names of the central members that turn, e.g. "sun" or "carrier".
std::string turning_members(Member fixed) {
    std::string names;
    for (const Member member : {Member::sun, Member::ring, Member::carrier}) {
        if (member != fixed) {
            names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", member_name(member));
        }
    }
    return names;
}

void check_operation(StudyDraft& draft) {
    const Operation& o = draft.study.operation;
    if (draft.study.gearbox.kind != GearboxKind::planetary ||
        !draft.all_usable({"gearbox.kind", "operation.fixed"})) {
        return;
    }
    const std::string_view fixed = member_name(o.fixed);
    const auto check_turns = [&](const std::string& key, Member member) {
        if (draft.all_usable({key}) && member == o.fixed) {
            draft.reject(key, fmt::format("is \"{}\", which stands still (operation.fixed)", fixed),
                         "use " + turning_members(o.fixed));
        }
    };
    check_turns("operation.input", o.input);
    check_turns("operation.torque_on", o.torque_on);
    const std::string speed = fmt::format("operation.{}_speed_rpm", fixed);
    if (draft.is_given(speed)) {
        draft.reject(speed, fmt::format("the {} stands still (operation.fixed)", fixed),
                     "give the speed of another member");
    }
}

void check_path(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!draft.all_usable({"gearbox.kind", "effects.motion", "effects.path"})) {
        return;
    }
    const bool fixed_shaft = s.gearbox.kind == GearboxKind::fixed_shaft;
    const bool none = s.effects.path == nullptr;
    if (s.effects.quasi_static() && !none) {
        draft.reject(
            "effects.path",
            "must be \"none\" (a quasi-static gearbox has no accelerations: effects.motion)",
            "use path = \"none\", or leave the key out");
    } else if (fixed_shaft && !none) {
        draft.reject("effects.path",
                     "must be \"none\" (the sensor of a fixed-shaft gearbox is on a bearing, and "
                     "no mesh moves past it)",
                     "use path = \"none\", or leave the key out");
    } else if (!fixed_shaft && !s.effects.quasi_static() && none) {
        draft.reject("effects.path",
                     "is \"none\" (a planetary gearbox's planets move past the sensor)",
                     "use path = \"rectangular\" to weight all planets equally");
    }
}

// Tian's model of a fixed-shaft gearbox has translations as well as rotations.
void check_fixed_shaft_motion(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.gearbox.kind == GearboxKind::fixed_shaft && s.effects.torsional() &&
        draft.all_usable({"gearbox.kind", "effects.motion"})) {
        draft.reject("effects.motion",
                     "has rotations only (a fixed-shaft gearbox's gears move on their bearings, "
                     "too)",
                     "use motion = \"translational-torsional\" or \"quasi-static\"");
    }
}

// Features of earlier versions, and what to use instead.
constexpr std::pair<std::string_view, std::string_view> kRemovedFeatures[] = {
    {"amplitude_modulation", "sideband_index"},
    {"phase_modulation", "sideband_index"},
    {"energy_operator", "fm4"},
    {"ar_residual_kurtosis", "fm4"},
    {"envelope_order", "kurtogram_peak"},
    {"cyclic_coherence", "kurtogram_peak"},
    {"med_kurtosis", "kurtogram_peak"},
    {"separated_fm4", "window_ratio"},
    {"spectral_kurtosis", "kurtogram_peak"},
    {"nb4", "na4"},
    {"nsds", "na4"}};

void check_feature(StudyDraft& draft, const std::string& name) {
    const features::Feature* feature = find_feature(draft.study, name);
    const std::string_view plain = std::string_view(name).substr(name.starts_with("own_") ? 4 : 0);
    const auto* removed = std::ranges::find(kRemovedFeatures, plain,
                                            &std::pair<std::string_view, std::string_view>::first);
    if (feature == nullptr && removed != std::end(kRemovedFeatures)) {
        draft.reject(
            "features.use", fmt::format("feature \"{}\" is no longer part of the program", name),
            fmt::format("use \"{}\", or compute it in Python (features.python)", removed->second));
    } else if (feature == nullptr) {
        std::vector<std::string_view> known;
        for (const features::Feature& other : features::all_features()) {
            known.push_back(other.name);
        }
        for (const PythonFeature& own : draft.study.features.python) {
            known.push_back(own.feature->name);
        }
        draft.reject("features.use", fmt::format("unknown feature \"{}\"", name),
                     suggest(name, known));
    } else if (feature->from_sensor && draft.study.effects.quasi_static() &&
               draft.usable("effects.motion")) {
        draft.reject("features.use",
                     fmt::format("\"{}\" needs the sensor (a quasi-static gearbox has no "
                                 "accelerations: effects.motion)",
                                 name),
                     "use features of the transmission error");
    } else if (feature->needs.overlaps(features::kCentralGears) &&
               draft.study.gearbox.kind == GearboxKind::fixed_shaft &&
               draft.usable("gearbox.kind")) {
        draft.reject("features.use",
                     fmt::format("\"{}\" needs a sun and a ring (gearbox.kind)", name),
                     "use window features without sun_ or ring_: they use the teeth of the gear "
                     "with the fault, else of the pinion");
    }
}

// Calls `check` for each name of a list; rejects names that occur twice.
template <class Check>
void check_names(StudyDraft& draft, const char* key, const std::vector<std::string>& names,
                 const char* remedy, const Check& check) {
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::find(names.begin(), name, *name) != name) {
            draft.reject(key, fmt::format("names \"{}\" twice", *name), remedy);
        } else {
            check(*name);
        }
    }
}

void check_features(StudyDraft& draft) {
    check_names(draft, "features.use", draft.study.features.use, "remove one of them",
                [&](const std::string& name) { check_feature(draft, name); });
}

void check_detectors(StudyDraft& draft) {
    constexpr const char* kKey = "monitoring.detectors";
    check_names(draft, kKey, draft.study.monitoring.detectors, "name it once",
                [&](const std::string& text) {
                    if (!analysis::parse_detector(text)) {
                        draft.reject(kKey, fmt::format("\"{}\" is not a detector", text),
                                     "use " + analysis::detector_forms());
                    }
                });
}

void check_uncertain_inputs(StudyDraft& draft) {
    constexpr const char* kKey = "detection.uncertain_inputs";
    check_names(draft, kKey, draft.study.detection.uncertain_inputs, "name it once",
                [&](const std::string& key) {
                    const RandomInput* drawn = draft.study.find_random(key);
                    if (drawn == nullptr || drawn->kind == InputKind::fault_size) {
                        draft.reject(
                            kKey, fmt::format("\"{}\" is not a random input of the gearboxes", key),
                            "name keys of [random] other than the fault's");
                    }
                });
}

void check_chosen_values(StudyDraft& draft) {
    constexpr const char* kKey = "detection.chosen_values";
    const std::vector<std::string> keys{"features.baseline_torque_scatter", "gearbox.tooth_quality",
                                        "sensor.noise_m_s2",
                                        "sensor.noise_density_m_s2_per_sqrt_Hz"};
    check_names(draft, kKey, draft.study.detection.chosen_values, "name it once",
                [&](const std::string& key) {
                    if (std::ranges::count(keys, key) == 0) {
                        draft.reject(kKey, fmt::format("the answer does not mark \"{}\"", key),
                                     fmt::format("use one of {}", fmt::join(keys, ", ")));
                    }
                });
}

// Rejects numbers of records that cannot be divided equally among the kinds of importance-sampled
// records.
void check_importance_sampling(StudyDraft& draft) {
    const Ensemble& e = draft.study.ensemble;
    constexpr auto kKinds = static_cast<int>(signals::NoiseImportanceSampler::kKinds);
    // The presence check rejects tilting of a single record.
    if (e.uses_importance_sampling() && e.threshold_records > 1 &&
        draft.all_usable({"ensemble.threshold_records"}) && e.threshold_records % kKinds != 0) {
        draft.reject("ensemble.threshold_records",
                     fmt::format("{} is not a multiple of {} (ensemble.threshold_tilt)",
                                 e.threshold_records, kKinds),
                     fmt::format("use {}", (e.threshold_records / kKinds + 1) * kKinds));
    }
}

void check_record_keys(StudyDraft& draft) {
    const Sensor& sensor = draft.study.sensor;
    if (sensor.record_s && sensor.record_turns) {
        draft.reject("sensor.record_turns",
                     "conflicts with record_s (both give the length of a record)",
                     "remove one of them");
    }
}

// Rejects unknown properties of an assembly, and properties that no gearbox of the study has.
void check_baseline_redraws(StudyDraft& draft) {
    constexpr const char* kKey = "features.baseline_redraws";
    const Study& study = draft.study;
    check_names(draft, kKey, study.features.baseline_redraws, "name it once",
                [&](const std::string& name) {
                    const bool pins = name == "pins";
                    if (!pins && name != "teeth") {
                        draft.reject(kKey, fmt::format("unknown property \"{}\"", name),
                                     suggest(name, {"pins", "teeth"}));
                    } else if (pins && !has_random_planets(study)) {
                        draft.reject(kKey, "\"pins\", but no pin has a random position",
                                     "give gearbox.pin_tangential_rms_um or pin_radial_rms_um, or "
                                     "remove it");
                    } else if (!pins && !has_tooth_errors(study)) {
                        draft.reject(kKey, "\"teeth\", but all teeth are alike",
                                     "give gearbox.tooth_quality, or remove it");
                    }
                });
}

void check_gravity(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.effects.gravity && s.effects.torsional() && planets_balance(s) &&
        draft.all_usable({"gearbox.kind", "gearbox.planet_positions_deg", "effects.motion",
                          "effects.gravity"}) &&
        s.gearbox.kind == GearboxKind::planetary) {
        draft.reject("effects.gravity",
                     "would have no effect (effects.motion has rotations only, and the torques of "
                     "the planets' weights about the carrier's axis cancel)",
                     "remove the key, or choose an effects.motion with translations in x and y");
    }
}

}  // namespace

void check_consistency(StudyDraft& draft) {
    check_importance_sampling(draft);
    check_operation(draft);
    check_path(draft);
    check_fixed_shaft_motion(draft);
    check_sampling(draft);
    check_features(draft);
    check_detectors(draft);
    check_uncertain_inputs(draft);
    check_chosen_values(draft);
    check_record_keys(draft);
    check_baseline_redraws(draft);
    check_gravity(draft);
}

}  // namespace gearpod::mc
