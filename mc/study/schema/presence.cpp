#include "mc/study/schema/presence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mc/study/assumptions.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/sensor_signal.hpp"

namespace gearpod::mc {
namespace {

const Presence kOptional{Need::optional, "", {}};
constexpr std::string_view kProfile = "gearbox.tooth_profile";
constexpr std::string_view kMotion = "effects.motion";

bool is(const Study& s, StiffnessSource profile) {
    return s.gearbox.tooth_profile == profile;
}

using Governors = decltype(Presence::governors);

Presence only_if(bool condition, std::string_view why, const Governors& governors = {},
                 const Presence& otherwise = kOptional) {
    return condition ? otherwise : Presence{Need::forbidden, std::string(why), governors};
}

Presence required_if(bool condition, std::string_view why, const Governors& governors = {},
                     const Presence& otherwise = kOptional) {
    return condition ? Presence{Need::required, std::string(why), governors} : otherwise;
}

// Required if the governor has the value that needs the key, else forbidden.
Presence with(bool needed, std::string_view because, std::string_view only,
              std::string_view governor) {
    return {needed ? Need::required : Need::forbidden,
            std::string(needed ? because : only),
            {governor}};
}

// Forbidden unless the gears are known.
Presence with_gears(const Study& s, std::string_view otherwise) {
    return only_if(
        has_gears(s), otherwise,
        {"gearbox.module_mm", "gearbox.sun.teeth", "gearbox.planet.teeth", "gearbox.ring.teeth"});
}

// Required if `other`, its key in the member's table, is given.
Presence blank_part(const Study& s, Member member, const std::optional<double>& given,
                    std::string_view other) {
    return only_if(s.effects.foundation != Foundation::none && !stiffness_given(s),
                   "only for elastic gear bodies, but effects.foundation is \"none\"",
                   {"effects.foundation"},
                   required_if(given.has_value(), member_key(member, other) + " is given"));
}

}  // namespace

Presence with_baseline(const Study& s) {
    const bool known = std::ranges::all_of(s.features.use, [&](const std::string& name) {
        return find_feature(s, name) != nullptr;  // others are rejected
    });
    return only_if(compares_records(s) || !known,
                   "only with features that use a baseline record (change_..., own_...)",
                   {"features.use"});
}
Presence with_alarm_target(const Study& s) {
    return only_if(has_alarm_target(s), "only with false_alarms_per_1000_h",
                   {"detection.false_alarms_per_1000_h"});
}
Presence alarm_target_needs(const Study& s) {
    return required_if(has_alarm_target(s) && !s.life.interval_h,
                       "hours between two records turn the target into a rate");
}
Presence paris_needs(const Study& s) {
    return only_if(!s.life.interval_h || s.life.curve_h.empty(),
                   "life.curve_h gives the depth of the crack", {"life.curve_h"},
                   needed_with<"life.interval_h">(s));
}
Presence always(const Study&) {
    return {Need::required, "", {}};
}
Presence may(const Study&) {
    return kOptional;
}

Presence of_kind(const Study& s, GearboxKind kind, const PresenceRule& rule) {
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
    if (s.gearbox.kind == GearboxKind::fixed_shaft) {
        return {Need::required, "", {}};
    }
    return required_if(!is(s, StiffnessSource::constant),
                       "gearbox.tooth_profile is not \"constant\"", {kProfile});
}

Presence tooth_module(const Study& s) {
    return only_if(
        !s.gearbox.normal_module_m, "gearbox.normal_module_mm is given",
        {"gearbox.normal_module_mm"},
        required_if(s.gearbox.kind == GearboxKind::fixed_shaft, "gearbox.kind is \"fixed-shaft\"",
                    {"gearbox.kind"}, tooth_numbers(s)));
}

Presence shifted_teeth(const Study& s) {
    return with_gears(s, "only with tooth numbers and module");
}

Presence tip_relief_length(const Study& s, Member member) {
    const std::optional<double>& amount = s.gearbox.bodies[member].tip_relief_m;
    const std::string key = member_key(member, "tip_relief_um");
    return only_if(amount.has_value(), "only with " + key, {},
                   required_if(amount > 0.0, key + " is given"));
}

Presence rim(const Study& s, Member member) {
    return blank_part(s, member, s.gearbox.bodies[member].web_m, "web_mm");
}

Presence web(const Study& s, Member member) {
    return blank_part(s, member, s.gearbox.bodies[member].rim_m, "rim_mm");
}

Presence tooth_body(const Study& s) {
    return required_if(!stiffness_given(s),
                       "gearbox.tooth_profile is neither \"constant\" nor \"square-wave\"",
                       {kProfile});
}

Presence tooth_model(const Study& s) {
    return only_if(!stiffness_given(s),
                   "the stiffness is given, not computed from the teeth: gearbox.tooth_profile",
                   {kProfile});
}

Presence constant_stiffness(const Study& s) {
    return with(is(s, StiffnessSource::constant), "gearbox.tooth_profile is \"constant\"",
                "only for gearbox.tooth_profile = \"constant\"; else the teeth define it",
                kProfile);
}

Presence foundation(const Study& s) {
    return required_if(s.effects.foundation != Foundation::none && !stiffness_given(s),
                       "effects.foundation is not \"none\"", {"effects.foundation"});
}

Presence ring_foundation(const Study& s) {
    // Sainsot's formula is fitted to external gears only.
    return required_if(s.effects.foundation == Foundation::elastic_ring && !stiffness_given(s),
                       "effects.foundation is \"elastic-ring\"", {"effects.foundation"});
}

Presence tooth_quality(const Study& s) {
    return with_gears(s, "tolerances need tooth numbers and module");
}

Presence bearings_move(const Study& s) {
    return only_if(!s.effects.torsional(), "the bearings of this model are rigid: effects.motion",
                   {kMotion});
}

Presence mass(const Study& s) {
    // A quasi-static gearbox needs its masses only for their weight.
    if (s.effects.quasi_static() && s.effects.gravity) {
        return {Need::required, "effects.gravity = true", {kMotion, "effects.gravity"}};
    }
    return required_if(!s.effects.quasi_static(), "", {kMotion});
}

Presence inertia(const Study& s) {
    return only_if(s.gearbox.kind == GearboxKind::fixed_shaft ||
                       (s.gearbox.has_teeth() && s.gearbox.transverse_module_m()),
                   "the radius is unknown without tooth numbers and module", {kProfile});
}

Presence inertia_over_r2(const Study& s) {
    const bool no_disc = is(s, StiffnessSource::constant) && !s.gearbox.has_teeth();
    return required_if(no_disc && !s.effects.quasi_static(),
                       "without tooth numbers no disc can be assumed", {kProfile, kMotion});
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
    return only_if(!s.effects.quasi_static(),
                   "a quasi-static gearbox has no accelerations: effects.motion", {kMotion});
}

Presence white_records(const Study& s) {
    constexpr std::string_view kRecords = "ensemble.threshold_records";
    constexpr std::string_view kDensity = "sensor.noise_density_m_s2_per_sqrt_Hz";
    return only_if(
        s.ensemble.threshold_records != 1, "only with ensemble.threshold_records", {kRecords},
        only_if(!s.sensor.noise_density_m_s2_per_sqrt_Hz,
                "tilting needs white noise: noise_density_m_s2_per_sqrt_Hz colours it",
                {kDensity, kMotion},
                only_if(!has_background(s), "tilting needs white noise: background_Hz colours it",
                        {"sensor.background_Hz", kMotion}, acceleration_detail(s))));
}

Presence acceleration(const Study& s) {
    const Presence detail = acceleration_detail(s);
    return detail.need == Need::forbidden ? detail : Presence{Need::required, "", {kMotion}};
}

Presence integration(const Study& s) {
    return only_if(!s.effects.quasi_static(),
                   "a quasi-static gearbox is not integrated in time: effects.motion", {kMotion});
}

Presence length_edges(const Study& s) {
    return only_if(s.fault.kind == nullptr || !s.fault.kind->size().unit.suffix.empty(),
                   "the fault's size is a pure number: use size_edges", {"fault.kind"});
}

Presence number_edges(const Study& s) {
    return only_if(s.fault.kind == nullptr || s.fault.kind->size().unit.suffix.empty(),
                   "the fault's size is a length: use size_edges_mm", {"fault.kind"});
}

Presence without_response(const Study& s) {
    constexpr std::string_view kResponse = "sensor.response_Hz";
    return only_if(!gives(s, kResponse), "a measured response contains the modes", {kResponse},
                   acceleration_detail(s));
}

Presence belonging_to_choice(const Study& s, std::string_view choice, std::string_view value) {
    const std::size_t dot = choice.find('.');
    return with(choice_text(s, choice.substr(0, dot), choice.substr(dot + 1)) == value,
                fmt::format("{} is \"{}\"", choice, value),
                fmt::format("only for {} = \"{}\"", choice, value), choice);
}

bool gives(const Study& s, std::string_view path) {
    return std::visit(
        [&](const auto& access) {
            if constexpr (requires { access.texts(s); }) {
                return !access.texts(s).empty();
            } else if constexpr (requires { access.get(s).empty(); }) {
                return !access.get(s).empty();
            } else {
                return access.get(s).has_value();
            }
        },
        find_key(path)->access);
}

Presence belonging_to(const Study& s, std::string_view other, const Presence& otherwise) {
    return only_if(gives(s, other), fmt::format("only with {}", other), {other}, otherwise);
}

}  // namespace gearpod::mc
