#include "mc/report/description/describe_effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/numerics/measured_effects.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/instance_inputs.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/report/description/describe_gearbox.hpp"
#include "mc/report/description/terminal_text.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/schema/schema.hpp"
#include "stiffness/foundation/foundation_models.hpp"

namespace gearpod::mc {
namespace {

// True if the damping is 0 in every gearbox. Random values are never 0.
bool none(const Study& study, const std::string& key, double nominal) {
    return nominal == 0.0 && study.find_random(key) == nullptr;
}

bool no_mesh_damping(const Study& study, const dynamics::DampingParameters& nominal) {
    return dynamics::with_mesh_damping(study.effects.mesh_damping, [&](auto law) {
        std::size_t next = 0;
        return std::ranges::all_of(law.kParameters, [&](const dynamics::DampingParameter& one) {
            return none(study, "gearbox." + std::string(one.key), nominal[next++]);
        });
    });
}

std::vector<Member> supported_members(const Study& study) {
    if (study.gearbox.kind == GearboxKind::fixed_shaft) {
        return {Member::pinion, Member::gear};
    }
    return {Member::sun, Member::planet, Member::ring, Member::carrier};
}

}  // namespace

std::string undamped(const Study& study) {
    if (study.effects.quasi_static()) {
        return "";
    }
    const Gearbox& g = study.gearbox;
    const InstanceInputs nominal = nominal_inputs(study);
    std::vector<std::string> parts, bearings;
    if (no_mesh_damping(study, nominal.mesh_damping)) {
        parts.push_back("meshes");
    }
    for (const Member member : supported_members(study)) {
        const std::string name(member_name(member));
        if (!study.effects.torsional() && none(study, "gearbox." + name + "_bearing_damping_N_s_m",
                                               g.bodies[member].bearing_damping_N_s_m)) {
            bearings.push_back(name);
        }
    }
    if (!bearings.empty()) {
        parts.push_back(fmt::format("bearings of {}", fmt::join(bearings, " and ")));
    }
    if (g.kind == GearboxKind::planetary) {
        if (none(study, "gearbox.support_damping_N_s_m", g.support_damping_N_s_m)) {
            parts.push_back(fmt::format("support of the {}", member_name(study.operation.fixed)));
        }
    } else {
        const FixedShaft& f = study.fixed_shaft;
        if (none(study, "gearbox.motor_coupling_damping_N_m_s_rad",
                 f.motor_coupling_damping_N_m_s_rad)) {
            parts.push_back("motor coupling");
        }
        if (none(study, "gearbox.load_coupling_damping_N_m_s_rad",
                 f.load_coupling_damping_N_m_s_rad)) {
            parts.push_back("load coupling");
        }
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

namespace {

std::string choice(const Study& study, const char* section, const char* name) {
    return std::string(choice_text(study, section, name));
}

bool random(const Study& study, const char* key) {
    return study.find_random(key) != nullptr;
}

void print_motion(const Study& study) {
    const Effects& e = study.effects;
    std::string text = e.torsional() ? "rotation only (rigid bearings)" : "x, y and rotation";
    if (e.quasi_static()) {
        text += ", quasi-static: equilibrium without inertia at every sample";
    }
    print_entry("motion", text);
    if (!e.quasi_static()) {
        print_entry("mesh damping", std::string(dynamics::with_mesh_damping(
                                        e.mesh_damping, [](auto law) { return law.kText; })));
    }
    if (study.gearbox.kind == GearboxKind::planetary && e.inertial_terms && !e.torsional()) {
        print_entry("inertial terms", e.quasi_static()
                                          ? "centrifugal force"
                                          : "Coriolis and centrifugal; rigid-body rotation is "
                                            "removed after every mesh period");
    }
}

// Warns of gears outside the range for which their foundation model was fitted.
void print_foundation_warnings(const Study& study) {
    std::set<Member> members;
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        members.insert({mesh.member_1, mesh.member_2});
    }
    for (const Member member : members) {
        for (const std::string& warning : stiffness::foundation_warnings(
                 gear_of(study, member), profile_of(study), study.effects.foundation,
                 body_radius_m(study, member))) {
            print_paragraph(fmt::format("warning: {}: {}", member_name(member), warning));
        }
    }
}

// Prints the stiffness factor of rim and web, for example
// "sun-planet mesh stiffness times 0.84 (C_R of ISO 6336-1: sun 0.84)".
void print_blanks(const Study& study) {
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        std::vector<std::string> blanks;
        for (const Member member : {mesh.member_1, mesh.member_2}) {
            if (study.gearbox.bodies[member].web_m) {
                blanks.push_back(
                    fmt::format("{} {:.4g}", member_name(member), blank_factor(study, member)));
            }
        }
        if (!blanks.empty()) {
            print_entry(
                "rim and web",
                fmt::format("{} mesh stiffness times {:.4g} (C_R of ISO 6336-1: {})",
                            mesh_name(mesh), blank_factor(study, mesh), fmt::join(blanks, ", ")));
        }
    }
}

void add_size(const Study& study, const char* key, const std::string& unit, double size,
              const char* what, std::vector<std::string>& parts) {
    if (study.find_random(key) != nullptr) {
        parts.push_back(fmt::format("{} random", what));
    } else if (size > 0.0) {
        parts.push_back(fmt::format("{} {:g}{}", what, size, unit));
    }
}

// Lists the tooth errors, for example "ISO 1328 grade 6, ring 8; pitch 2 um rms".
std::string tooth_errors(const Study& study) {
    const MeshErrors& e = study.errors;
    std::vector<std::string> parts, members;
    for (const Member member : kAllMembers) {
        if (const auto& grade = study.gearbox.bodies[member].quality) {
            members.push_back(fmt::format("{} {:g}", member_name(member), *grade));
        }
    }
    if (has_tooth_quality(study)) {
        const std::string all = study.find_random("gearbox.tooth_quality") ? "random"
                                : e.tooth_quality ? fmt::format("{:g}", *e.tooth_quality)
                                                  : "";
        parts.push_back(fmt::format("ISO 1328 grade {}{}{}", all,
                                    members.empty() || all.empty() ? "" : ", ",
                                    fmt::join(members, ", ")));
    }
    if (has_measured_teeth(study)) {
        parts.push_back("measured index deviations");
    }
    const auto add = [&](const char* key, double rms_m, const char* what) {
        add_size(study, key, " um rms", 1e6 * rms_m, what, parts);
    };
    add("gearbox.pitch_error_um", e.pitch_error_m, "pitch");
    add("gearbox.index_wave_um", e.index_wave_m, "index waves");
    add("gearbox.eccentricity_um", e.eccentricity_m, "eccentricity");
    add("gearbox.profile_slope_um", e.profile_slope_m, "profile slopes");
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string unequal_planets_text(const Study& study) {
    const PlanetDifferences& p = study.planets;
    std::vector<std::string> parts;
    for (const auto& [list, what] :
         {std::pair{&p.pin_tangential_m, "tangential pin errors"},
          std::pair{&p.pin_radial_m, "radial pin errors"},
          std::pair{&p.bearing_stiffness, "bearing stiffness"},
          std::pair{&p.bearing_damping, "bearing damping"}, std::pair{&p.mass, "masses"}}) {
        if (!list->empty()) {
            parts.push_back(fmt::format("{} given", what));
        }
    }
    const auto add = [&](const char* key, double size, const char* unit, const char* what) {
        add_size(study, key, unit, size, what, parts);
    };
    add("gearbox.pin_tangential_rms_um", 1e6 * p.pin_tangential_rms_m, " um rms",
        "tangential pin errors");
    add("gearbox.pin_radial_rms_um", 1e6 * p.pin_radial_rms_m, " um rms", "radial pin errors");
    add("gearbox.planet_bearing_stiffness_scatter", p.bearing_stiffness_scatter, "",
        "bearing stiffness scatter");
    add("gearbox.planet_bearing_damping_scatter", p.bearing_damping_scatter, "",
        "bearing damping scatter");
    add("gearbox.planet_mass_scatter", p.mass_scatter, "", "mass scatter");
    return fmt::format("{}", fmt::join(parts, "; "));
}

void print_meshes(const Study& study) {
    const Effects& e = study.effects;
    if (!stiffness_given(study)) {
        print_entry("teeth", fmt::format("{} profile{}", choice(study, "gearbox", "tooth_profile"),
                                         e.shear ? "" : ", without shear energy"));
        if (e.foundation != Foundation::none) {
            print_entry("foundation", choice(study, "effects", "foundation"));
            print_foundation_warnings(study);
            print_blanks(study);
        }
        if (e.contact == Contact::load_dependent) {
            print_entry("contact", "stiffness depends on the contact force at nominal torque");
        }
    }
    if (e.separation != Separation::none) {
        print_entry("tooth separation",
                    e.separation == Separation::one_sided
                        ? "one-sided: contact loss, but no contact of the back flanks"
                        : fmt::format("two-sided, backlash {:g} mm",
                                      1e3 * study.gearbox.backlash_m.value_or(0.0)));
    }
    if (has_static_errors(study)) {
        print_entry("transmission error", "harmonics of the mesh frequency");
    }
    if (has_tooth_errors(study)) {
        print_entry("tooth errors", tooth_errors(study));
    }
    if (has_relief(study)) {
        print_entry("relief", "gap of each tooth pair along its path of contact");
    }
    if (study.effects.contact_onset == ContactOnset::extended) {
        print_entry("contact onset", "extended: tip corner contact before and after the path");
    }
    if (has_unilateral_teeth(study)) {
        print_entry("tooth pairs", "unilateral contact: pairs push but never pull");
    }
    if (has_unequal_planets(study)) {
        print_entry("unequal planets", unequal_planets_text(study));
    }
}

// Nominal sizes of the sinusoidal and the random part of a fluctuation.
std::string sizes(double amplitude, const std::string& rate, double rms, double band_Hz) {
    std::string text =
        rate.empty() ? "" : fmt::format("sine with {:g} of the mean, {}", amplitude, rate);
    if (band_Hz > 0.0) {
        text += fmt::format("{}noise with {:g} rms of the mean, up to {:g} Hz",
                            text.empty() ? "" : "; ", rms, band_Hz);
    }
    return text;
}

void print_excitation(const Study& study) {
    const FluctuationInstance f = nominal_inputs(study).fluctuations;
    if (torque_fluctuates(study)) {
        const std::string rate = !torque_has_sine(study) ? ""
                                 : f.torque_order > 0.0
                                     ? fmt::format("{:g} per input revolution", f.torque_order)
                                     : fmt::format("{:g} Hz", f.torque_Hz);
        print_entry("torque fluctuation", sizes(f.torque, rate, f.torque_noise,
                                                torque_has_noise(study) ? f.torque_noise_Hz : 0.0));
    }
    if (speed_fluctuates(study)) {
        const std::string rate =
            speed_has_sine(study) ? fmt::format("{:g} per input revolution", f.speed_order) : "";
        print_entry("speed fluctuation", sizes(f.speed, rate, f.speed_noise,
                                               speed_has_noise(study) ? f.speed_noise_Hz : 0.0));
    }
    if (study.effects.gravity) {
        print_entry("gravity",
                    fmt::format("{:g} deg from the x axis{}",
                                study.effects.gravity_direction_rad * 180.0 / std::numbers::pi,
                                gravity_turns(study) ? ", rotating in the carrier frame" : ""));
    }
    if (const std::string why = reason_not_periodic(study); !why.empty()) {
        print_entry("solution",
                    study.numerics.horizon == Horizon::superposed
                        ? "superposition of the responses to the errors of each gear; "
                          "full integration where a tooth pair may lose contact"
                        : fmt::format("computed for every mesh period, because {}{}", why,
                                      reason_not_superposed(study).empty()
                                          ? " (faster if no tooth pair loses contact: "
                                            "numerics.horizon = \"superposed\")"
                                          : ""));
    }
}

void print_omitted_excitation(const Study& study) {
    if (!torque_fluctuates(study)) {
        print_entry("torque fluctuation", "no operation.torque_fluctuation or torque_noise");
    }
    if (!speed_fluctuates(study)) {
        print_entry("speed fluctuation", study.effects.quasi_static()
                                             ? "no effect without inertia"
                                             : "no operation.speed_fluctuation or speed_noise");
    }
    if (!study.effects.gravity) {
        print_entry("gravity", study.effects.torsional() && planets_balance(study)
                                   ? "the planets' weights balance each other"
                                   : "effects.gravity = false");
    }
}

void print_fault(const FaultPlan& fault) {
    if (fault.given()) {
        print_entry("fault", fmt::format("{} on {}", fault.title, fault.location));
    }
}

bool has_sensor_noise(const Study& study) {
    return sensor_noise_m_s2(study) > 0.0 || random(study, noise_key(study)) ||
           random(study, "sensor.noise_m_s2");
}
bool encoder_noise(const Study& study) {
    return study.sensor.encoder_noise_rad > 0.0 || random(study, "sensor.encoder_noise_arcsec");
}

void print_omitted(const Scene& scene) {
    const Study& study = scene.study();
    const Effects& e = study.effects;
    print_heading("effects omitted");
    if (e.quasi_static()) {
        print_entry("inertia and damping",
                    fmt::format("effects.motion = \"{}\"", choice(study, "effects", "motion")));
        print_entry("sensor", "no acceleration without inertia");
    }
    if (e.torsional()) {
        print_entry("x and y motion",
                    fmt::format("effects.motion = \"{}\"", choice(study, "effects", "motion")));
        print_entry("inertial terms", "no effect on rotation");
    } else if (study.gearbox.kind == GearboxKind::planetary && !e.inertial_terms) {
        print_entry("inertial terms", "effects.inertial_terms = false");
    }
    print_omitted_excitation(study);
    if (!stiffness_given(study) && e.foundation == Foundation::none) {
        print_entry("gear bodies", "effects.foundation = \"none\"");
    }
    if (study.gearbox.helix_angle_rad > 0.0) {
        print_entry("axial motion, tilting", "helical gears move in the transverse plane only");
    }
    if (!scene.fault().plan().given()) {
        print_entry("fault", "fault.kind = \"none\"");
    }
    if (!e.quasi_static() && !has_sensor_noise(study)) {
        print_entry("sensor noise", fmt::format("{} is 0", noise_key(study)));
    }
    if (!encoder_noise(study)) {
        print_entry("encoder noise", "sensor.encoder_noise_arcsec is 0");
    }
    if (const std::string without = undamped(study); !without.empty()) {
        print_entry("damping", "0 for " + without);
    }
    if (!std::isfinite(scene.decay_meshes())) {
        print_paragraph(
            "warning: the vibration is undamped, so no gearbox converges to the periodic steady "
            "state");
    }
    if (!has_tooth_errors(study)) {
        print_entry("tooth errors", "all teeth of a gear are identical");
    }
    if (study.gearbox.kind == GearboxKind::planetary && !has_unequal_planets(study)) {
        print_entry("unequal planets", "exact pin positions, equal bearings and masses");
    }
    if (!has_static_errors(study) && !has_tooth_errors(study) && !has_relief(study)) {
        print_entry("transmission error", "ideal tooth flanks");
    }
    if (!stiffness_given(study) && e.contact_onset == ContactOnset::abrupt) {
        print_entry("contact beyond the path",
                    "effects.contact_onset = \"abrupt\": vibration is overestimated");
    }
    if (e.separation == Separation::none && !has_unilateral_teeth(study)) {
        print_entry("tooth separation", "meshes are springs that never lose contact");
    }
}

}  // namespace

void print_effects(const Scene& scene) {
    const Study& study = scene.study();
    print_heading("effects simulated");
    print_motion(study);
    print_meshes(study);
    print_excitation(study);
    print_fault(scene.fault().plan());
    if (!study.effects.quasi_static()) {
        print_sensors(scene);
        if (has_sensor_noise(study)) {
            print_entry("sensor noise", noise_text(study));
        }
    }
    if (encoder_noise(study)) {
        print_entry("encoder noise", fmt::format("{:.4g} rad rms times the noise level",
                                                 study.sensor.encoder_noise_rad));
    }
    if (compares_records(study)) {
        print_entry("baseline", fmt::format("a healthy record of every gearbox, at a torque that "
                                            "scatters by {:g} % (rms)",
                                            100.0 * study.features.baseline_torque_scatter));
    }
    print_omitted(scene);
}

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
                                 record_length_text(brief.plan(brief.facts().numerics).record())));
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
