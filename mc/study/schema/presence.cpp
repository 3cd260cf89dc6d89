#include "mc/study/schema/presence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/study/false_alarm_target.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

const Presence kOptional{Need::optional, "", {}};
constexpr std::string_view kProfile = "gearbox.tooth_profile";
constexpr std::string_view kMotion = "effects.motion";

bool is(const Study& s, ToothProfile profile) {
    return s.gearbox.tooth_profile == profile;
}

// Forbidden unless the gears are known.
Presence with_gears(const Study& s, const std::string& otherwise) {
    return has_gears(s) ? kOptional
                        : Presence{Need::forbidden,
                                   otherwise,
                                   {"gearbox.module_mm", "gearbox.sun_teeth",
                                    "gearbox.planet_teeth", "gearbox.ring_teeth"}};
}

// Required if that key is given, else forbidden.
Presence with(const std::optional<double>& given, const std::string& because,
              const std::string& only, std::string_view governor) {
    return given ? Presence{Need::required, because, {governor}}
                 : Presence{Need::forbidden, only, {governor}};
}

}  // namespace

Presence with_baseline(const Study& s) {
    const bool known = std::ranges::all_of(s.features.use, [&](const std::string& name) {
        return find_feature(s, name) != nullptr;  // others are rejected
    });
    return compares_records(s) || !known
               ? kOptional
               : Presence{Need::forbidden,
                          "only with features that use a baseline record (change_..., own_...)",
                          {"features.use"}};
}
Presence with_alarm_target(const Study& s) {
    return has_alarm_target(s)
               ? kOptional
               : Presence{Need::forbidden,
                          "only with false_alarms_per_1000_h or false_alarms_per_year",
                          {"detection.false_alarms_per_1000_h", "detection.false_alarms_per_year"}};
}
Presence alarm_target_needs(const Study& s) {
    return has_alarm_target(s) && !s.life.interval_h
               ? Presence{Need::required,
                          "hours between two records turn the target into a rate",
                          {}}
               : may(s);
}
Presence of_life(const Study& s, Need need) {
    const Need there = s.life.interval_h ? need : Need::forbidden;
    return {
        there, there == Need::forbidden ? "only with life.interval_h" : "", {"life.interval_h"}};
}
Presence with_life(const Study& s) {
    return of_life(s, Need::optional);
}
Presence life_needs(const Study& s) {
    return of_life(s, Need::required);
}
Presence paris_needs(const Study& s) {
    return s.life.interval_h && !s.life.curve_h.empty()
               ? Presence{Need::forbidden,
                          "life.curve_h gives the depth of the crack",
                          {"life.curve_h"}}
               : life_needs(s);
}
Presence of_curve(const Study& s, Need need) {
    return s.life.curve_h.empty()
               ? Presence{Need::forbidden, "only with life.curve_h", {"life.curve_h"}}
               : of_life(s, need);
}
Presence curve_needs(const Study& s) {
    return of_curve(s, Need::required);
}
Presence with_curve(const Study& s) {
    return of_curve(s, Need::optional);
}
Presence always(const Study&) {
    return {Need::required, "", {}};
}
Presence may(const Study&) {
    return kOptional;
}

Presence of_kind(const Study& s, GearboxKind kind, Presence (*rule)(const Study&)) {
    if (s.gearbox.kind != kind) {
        return {Need::forbidden,
                kind == GearboxKind::planetary ? "only for gearbox.kind = \"planetary\""
                                               : "only for gearbox.kind = \"fixed-shaft\"",
                {"gearbox.kind"}};
    }
    Presence presence = rule(s);
    if (const auto unused = std::ranges::find(presence.governors, "");
        unused != presence.governors.end()) {
        *unused = "gearbox.kind";
    }
    return presence;
}

Presence tooth_numbers(const Study& s) {
    return is(s, ToothProfile::constant)
               ? kOptional
               : Presence{Need::required, "gearbox.tooth_profile is not \"constant\"", {kProfile}};
}

Presence tooth_module(const Study& s) {
    return s.gearbox.normal_module_m ? Presence{Need::forbidden,
                                                "gearbox.normal_module_mm is given",
                                                {"gearbox.normal_module_mm"}}
           : s.gearbox.kind == GearboxKind::fixed_shaft
               ? Presence{Need::required, "gearbox.kind is \"fixed-shaft\"", {"gearbox.kind"}}
               : tooth_numbers(s);
}

Presence shifted_teeth(const Study& s) {
    return with_gears(s, "only with tooth numbers and module");
}

Presence relief_shape(const Study& s) {
    const bool any = std::any_of(kAllMembers.begin(), kAllMembers.end(),
                                 [&](Member member) { return relief_of(s, member).of_profile(); });
    return any ? kOptional : Presence{Need::forbidden, "only with tip or root relief", {}};
}

Presence flank_gaps(const Study& s) {
    constexpr const char* kWhy = "only with relief, crowning or an extended contact_onset";
    return has_flank_gaps(s) ? kOptional : Presence{Need::forbidden, kWhy, {}};
}

Presence relief_length(const Study& s, Member member, std::string_view end) {
    const MemberValues& body = s.gearbox.bodies[member];
    const auto& amount = end == "tip" ? body.tip_relief_m : body.root_relief_m;
    const std::string key = fmt::format("gearbox.{}_{}_relief_um", member_name(member), end);
    return !amount         ? Presence{Need::forbidden, "only with " + key, {}}
           : *amount > 0.0 ? Presence{Need::required, key + " is given", {}}
                           : kOptional;
}

Presence tooth_body(const Study& s) {
    return stiffness_given(s)
               ? kOptional
               : Presence{Need::required,
                          "gearbox.tooth_profile is neither \"constant\" nor \"square-wave\"",
                          {kProfile}};
}

Presence tooth_model(const Study& s) {
    return stiffness_given(s) ? Presence{Need::forbidden,
                                         "the stiffness is given, not computed from the teeth: "
                                         "gearbox.tooth_profile",
                                         {kProfile}}
                              : kOptional;
}

Presence constant_stiffness(const Study& s) {
    return is(s, ToothProfile::constant)
               ? Presence{Need::required, "gearbox.tooth_profile is \"constant\"", {kProfile}}
               : Presence{Need::forbidden,
                          "only for gearbox.tooth_profile = \"constant\"; else the teeth define it",
                          {kProfile}};
}

Presence square_wave(const Study& s) {
    return is(s, ToothProfile::square_wave)
               ? Presence{Need::required, "gearbox.tooth_profile is \"square-wave\"", {kProfile}}
               : Presence{Need::forbidden,
                          "only for gearbox.tooth_profile = \"square-wave\"",
                          {kProfile}};
}

Presence foundation(const Study& s) {
    return s.effects.foundation == Foundation::none || stiffness_given(s)
               ? kOptional
               : Presence{
                     Need::required, "effects.foundation is not \"none\"", {"effects.foundation"}};
}

Presence ring_foundation(const Study& s) {
    // Sainsot's formula is fitted to external gears only.
    return s.effects.foundation == Foundation::elastic_ring && !stiffness_given(s)
               ? Presence{Need::required,
                          "effects.foundation is \"elastic-ring\"",
                          {"effects.foundation"}}
               : kOptional;
}

Presence blank_part(const Study& s, Member member, BlankPart part) {
    if (s.effects.foundation == Foundation::none || stiffness_given(s)) {
        return {Need::forbidden,
                "only for elastic gear bodies, but effects.foundation is \"none\"",
                {"effects.foundation"}};
    }
    const MemberValues& body = s.gearbox.bodies[member];
    const bool rim = part == BlankPart::rim;
    return (rim ? body.web_m : body.rim_m)
               ? Presence{Need::required,
                          fmt::format("gearbox.{}_{}_mm is given", member_name(member),
                                      rim ? "web" : "rim"),
                          {}}
               : kOptional;
}

Presence backlash(const Study& s) {
    return s.effects.separation == Separation::two_sided
               ? Presence{Need::required,
                          "effects.separation is \"two-sided\"",
                          {"effects.separation"}}
               : Presence{Need::forbidden,
                          "only for effects.separation = \"two-sided\"",
                          {"effects.separation"}};
}

Presence tooth_quality(const Study& s) {
    return with_gears(s, "tolerances need tooth numbers and module");
}

Presence bearings_move(const Study& s) {
    return s.effects.torsional() ? Presence{Need::forbidden,
                                            "the bearings of this model are rigid: effects.motion",
                                            {kMotion}}
                                 : kOptional;
}

Presence bearings_damp(const Study& s) {
    return s.effects.quasi_static() ? integration(s) : bearings_move(s);
}

Presence planet_masses(const Study& s) {
    return s.effects.gravity ? kOptional : integration(s);
}

Presence torque_sine(const Study& s) {
    return s.fluctuations.torque ? kOptional
                                 : Presence{Need::forbidden,
                                            "only with operation.torque_fluctuation",
                                            {"operation.torque_fluctuation"}};
}

Presence torque_noise(const Study& s) {
    return with(s.fluctuations.torque_noise, "operation.torque_noise is given",
                "only with operation.torque_noise", "operation.torque_noise");
}

Presence speed_sine(const Study& s) {
    return with(s.fluctuations.speed, "operation.speed_fluctuation is given",
                "only with operation.speed_fluctuation", "operation.speed_fluctuation");
}

Presence speed_phase(const Study& s) {
    return s.fluctuations.speed ? kOptional : speed_sine(s);
}

Presence speed_noise(const Study& s) {
    return with(s.fluctuations.speed_noise, "operation.speed_noise is given",
                "only with operation.speed_noise", "operation.speed_noise");
}

Presence gravity(const Study& s) {
    return s.effects.gravity
               ? kOptional
               : Presence{Need::forbidden, "only with effects.gravity = true", {"effects.gravity"}};
}

Presence mass(const Study& s) {
    // A quasi-static gearbox needs its masses only for their weight.
    if (s.effects.quasi_static() && s.effects.gravity) {
        return {Need::required, "effects.gravity = true", {kMotion, "effects.gravity"}};
    }
    return s.effects.quasi_static() ? kOptional : Presence{Need::required, "", {kMotion}};
}

Presence inertia(const Study& s) {
    return s.gearbox.has_teeth() && s.gearbox.transverse_module_m()
               ? kOptional
               : Presence{Need::forbidden,
                          "the radius is unknown without tooth numbers and module",
                          {kProfile}};
}

Presence inertia_over_r2(const Study& s) {
    const bool no_disc = is(s, ToothProfile::constant) && !s.gearbox.has_teeth();
    return no_disc && !s.effects.quasi_static()
               ? Presence{Need::required,
                          "without tooth numbers no disc can be assumed",
                          {kProfile, kMotion}}
               : kOptional;
}

Presence bearing(const Study& s) {
    switch (s.effects.motion) {
        case Motion::translational_torsional:
            return {Need::required, "effects.motion is \"translational-torsional\"", {kMotion}};
        case Motion::quasi_static:
            return {Need::required, "effects.motion is \"quasi-static\"", {kMotion}};
        case Motion::torsional:
        case Motion::quasi_static_torsional:
            return kOptional;
    }
    return kOptional;
}

Presence acceleration_detail(const Study& s) {
    return s.effects.quasi_static()
               ? Presence{Need::forbidden,
                          "a quasi-static gearbox has no accelerations: effects.motion",
                          {kMotion}}
               : kOptional;
}

Presence white_records(const Study& s) {
    constexpr std::string_view kRecords = "ensemble.threshold_records";
    if (s.ensemble.threshold_records == 1) {
        return {Need::forbidden, "only with ensemble.threshold_records", {kRecords}};
    }
    constexpr std::string_view kDensity = "sensor.noise_density_m_s2_per_sqrt_Hz";
    return s.sensor.noise_density_m_s2_per_sqrt_Hz
               ? Presence{Need::forbidden,
                          "tilting needs white noise: noise_density_m_s2_per_sqrt_Hz colours it",
                          {kDensity, kMotion}}
               : acceleration_detail(s);
}

Presence acceleration(const Study& s) {
    const Presence detail = acceleration_detail(s);
    return detail.need == Need::forbidden ? detail : Presence{Need::required, "", {kMotion}};
}

Presence integration(const Study& s) {
    return s.effects.quasi_static()
               ? Presence{Need::forbidden,
                          "a quasi-static gearbox is not integrated in time: effects.motion",
                          {kMotion}}
               : kOptional;
}

Presence length_edges(const Study& s) {
    return s.fault.kind == nullptr || !s.fault.kind->size().unit.suffix.empty()
               ? kOptional
               : Presence{Need::forbidden,
                          "the fault's size is a pure number: use size_edges",
                          {"fault.kind"}};
}

Presence number_edges(const Study& s) {
    return s.fault.kind == nullptr || s.fault.kind->size().unit.suffix.empty()
               ? kOptional
               : Presence{Need::forbidden,
                          "the fault's size is a length: use size_edges_mm",
                          {"fault.kind"}};
}

Presence until_part(const Study& s) {
    constexpr std::string_view governor = "ensemble.until.half_width";
    return s.ensemble.until.half_width
               ? Presence{Need::required, "until.half_width is given", governor}
               : Presence{Need::forbidden, "only with until.half_width", governor};
}
Presence until_level(const Study& s) {
    return s.ensemble.until.half_width ? may(s) : until_part(s);
}

}  // namespace gearpod::mc
