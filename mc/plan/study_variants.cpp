// A study without its optional effects or with others, and with other values of its assumptions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "mc/plan/planner.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

bool has_bodies_in_plane(const Study& s) {
    return s.gearbox.kind == GearboxKind::planetary && !s.effects.torsional();
}
bool has_real_teeth(const Study& s) {
    return s.gearbox.tooth_profile != StiffnessSource::constant &&
           s.gearbox.tooth_profile != StiffnessSource::square_wave;
}
bool always(const Study&) {
    return true;
}

// Removes the distributions of keys that begin with one of `starts`.
void give_up_random(Study& s, std::initializer_list<std::string_view> starts) {
    std::erase_if(s.random, [&](const RandomInput& input) {
        return std::ranges::any_of(starts,
                                   [&](auto start) { return input.key.starts_with(start); });
    });
    std::erase_if(s.correlations, [&](const Correlation& c) {
        return s.find_random(c.first) == nullptr || s.find_random(c.second) == nullptr;
    });
}

void remove_tooth_errors(Study& s) {
    s.errors.tooth_quality.reset();
    s.errors.pitch_error_m = s.errors.eccentricity_m = 0.0;
    for (MemberValues& body : s.gearbox.bodies.values) {
        body.quality.reset();
        body.index_m.clear();
        body.ring_side_index_m.clear();
    }
    give_up_random(s, {"gearbox.tooth_quality", "gearbox.pitch_error", "gearbox.eccentricity"});
}

bool has_pin_errors(const Study& s) {
    const PlanetDifferences& p = s.planets;
    return p.pin_tangential_rms_m > 0.0 || p.pin_radial_rms_m > 0.0 ||
           !p.pin_tangential_m.empty() || !p.pin_radial_m.empty();
}
void remove_pin_errors(Study& s) {
    s.planets.pin_tangential_m.clear();
    s.planets.pin_radial_m.clear();
    s.planets.pin_tangential_rms_m = s.planets.pin_radial_rms_m = 0.0;
    give_up_random(s, {"gearbox.pin_"});
}

void remove_relief(Study& s) {
    for (MemberValues& body : s.gearbox.bodies.values) {
        for (auto* value : {&body.tip_relief_m, &body.tip_relief_length_m, &body.crowning_m}) {
            value->reset();
        }
    }
}

void remove_torque_fluctuation(Study& s) {
    Fluctuations& f = s.fluctuations;
    f.torque_noise.reset();
    f.torque_noise_Hz.reset();
    give_up_random(s, {"operation.torque_noise"});
}
void remove_speed_fluctuation(Study& s) {
    Fluctuations& f = s.fluctuations;
    f.speed.reset();
    f.speed_order.reset();
    f.speed_noise.reset();
    f.speed_noise_Hz.reset();
    f.speed_phase_rad = 0.0;
    give_up_random(s, {"operation.speed_fluctuation", "operation.speed_noise"});
}

struct OptionalEffect {
    const char* name;
    bool (*applies)(const Study&);
    bool (*present)(const Study&);
    void (*remove)(Study&);
    void (*add)(Study&) = nullptr;  // null: an effect that needs further values is not added
};

const OptionalEffect kOptionalEffects[] = {
    {"inertial terms", has_bodies_in_plane, [](const Study& s) { return s.effects.inertial_terms; },
     [](Study& s) { s.effects.inertial_terms = false; },
     [](Study& s) { s.effects.inertial_terms = true; }},
    {"gravity", always, [](const Study& s) { return s.effects.gravity; },
     [](Study& s) { s.effects.gravity = false; }, [](Study& s) { s.effects.gravity = true; }},
    {"extended contact", has_real_teeth,
     [](const Study& s) { return s.effects.contact_onset == ContactOnset::extended; },
     [](Study& s) { s.effects.contact_onset = ContactOnset::abrupt; },
     [](Study& s) { s.effects.contact_onset = ContactOnset::extended; }},
    {"tooth separation", always,
     [](const Study& s) {
         return s.effects.separation != Separation::none && !has_unilateral_teeth(s);
     },
     [](Study& s) { s.effects.separation = Separation::none; }},
    {"tooth errors", always, has_tooth_errors, remove_tooth_errors},
    {"pin errors", always, has_pin_errors, remove_pin_errors},
    {"relief and crowning", always, has_relief, remove_relief},
    {"elastic gear bodies", has_real_teeth,
     [](const Study& s) { return s.effects.foundation != Foundation::none; },
     [](Study& s) { s.effects.foundation = Foundation::none; }},
    {"load-dependent contact", has_real_teeth,
     [](const Study& s) { return s.effects.contact != Contact::linear; },
     [](Study& s) { s.effects.contact = Contact::linear; }},
    {"shear of the teeth", has_real_teeth, [](const Study& s) { return s.effects.shear; },
     [](Study& s) { s.effects.shear = false; }, [](Study& s) { s.effects.shear = true; }},
    {"torque fluctuation", always, torque_fluctuates, remove_torque_fluctuation},
    {"speed fluctuation", always, speed_fluctuates, remove_speed_fluctuation},
    {"transmission path", has_bodies_in_plane,
     [](const Study& s) {
         return s.effects.path != nullptr && s.effects.path != &signals::path_window("rectangular");
     },
     [](Study& s) { s.effects.path = &signals::path_window("rectangular"); }}};

bool scales_tooth_errors(const Study& s) {
    return (s.errors.tooth_quality || s.errors.pitch_error_m > 0.0 ||
            s.errors.eccentricity_m > 0.0) &&
           std::ranges::none_of(s.random, [](const RandomInput& input) {
               return input.key.ends_with("quality") || input.key == "gearbox.pitch_error_um" ||
                      input.key == "gearbox.eccentricity_um";
           });
}
void scale_tooth_errors(Study& s, double factor) {
    const double grades = 2.0 * std::log2(factor);  // ISO 1328-1: a grade is a factor of sqrt(2)
    if (s.errors.tooth_quality) {
        *s.errors.tooth_quality += grades;
    }
    for (MemberValues& body : s.gearbox.bodies.values) {
        if (body.quality) {
            *body.quality += grades;
        }
    }
    s.errors.pitch_error_m *= factor;
    s.errors.eccentricity_m *= factor;
}

// Values that a study assumes, because measuring them takes the machine.
struct Assumption {
    const char* key;
    bool (*present)(const Study&);
    void (*scale)(Study&, double factor);
};

const Assumption kAssumptions[] = {
    {"features.baseline_torque_scatter",
     [](const Study& s) { return compares_records(s) && s.features.baseline_torque_scatter > 0.0; },
     [](Study& s, double factor) { s.features.baseline_torque_scatter *= factor; }},
    // Several levels show their effect themselves.
    {"sensor.noise_levels",
     [](const Study& s) {
         return std::ranges::count_if(s.sensor.noise_levels, [](double x) { return x > 0.0; }) == 1;
     },
     [](Study& s, double factor) {
         for (double& level : s.sensor.noise_levels) {
             level *= factor;
         }
     }},
    {"gearbox.tooth_quality", scales_tooth_errors, scale_tooth_errors}};

// Plans of a changed study, which must be valid as if it were read.
Planner planner_of(const Study& changed) {
    const StudyReading reading = read_study_text(resolved_text(changed), "");
    if (!reading.study) {
        const Problem& problem = reading.problems.front();
        throw SceneError(problem.key, problem.what, problem.remedy);
    }
    return Planner(*reading.study);
}

}  // namespace

std::vector<EffectVariant> effect_variants(const Study& study) {
    std::vector<EffectVariant> variants;
    for (const OptionalEffect& effect : kOptionalEffects) {
        const bool present = effect.present(study);
        if (!effect.applies(study) || (!present && effect.add == nullptr)) {
            continue;
        }
        Study changed = study;
        (present ? effect.remove : effect.add)(changed);
        if (!reason_not_periodic(study).empty() && reason_not_periodic(changed).empty()) {
            changed.numerics.horizon = Horizon::periodic;  // as without the key
        }
        variants.push_back(
            {effect.name, present, [changed = std::move(changed)] { return planner_of(changed); }});
    }
    return variants;
}

std::vector<AssumptionVariant> assumption_variants(const Study& study) {
    std::vector<AssumptionVariant> variants;
    for (const Assumption& assumption : kAssumptions) {
        if (!assumption.present(study)) {
            continue;
        }
        for (const double factor : {0.5, 2.0}) {
            Study changed = study;
            assumption.scale(changed, factor);
            variants.push_back({assumption.key, factor,
                                [changed = std::move(changed)] { return planner_of(changed); }});
        }
    }
    return variants;
}

}  // namespace gearpod::mc
