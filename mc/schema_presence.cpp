#include "mc/schema_presence.hpp"

namespace gearpod::mc {
namespace {

bool constant_profile(const Study& s) {
    return s.gearbox.tooth_profile == ToothProfile::constant;
}

bool planet_crack(const Study& s) {
    return s.fault.kind == FaultKind::crack && s.fault.member == Member::planet;
}

Presence damping(const Study& s, MeshDamping kind, std::string_view why) {
    constexpr std::string_view governor = "effects.mesh_damping";
    return s.effects.mesh_damping == kind ? Presence{Need::required, why, governor}
                                          : Presence{Need::forbidden, why, governor};
}

}  // namespace

Presence always(const Study&) {
    return {Need::required, "", ""};
}
Presence may(const Study&) {
    return {Need::optional, "", ""};
}

Presence tooth_geometry(const Study& s) {
    return constant_profile(s)
               ? Presence{Need::optional, "", ""}
               : Presence{Need::required, "gearbox.tooth_profile is not \"constant\"",
                          "gearbox.tooth_profile"};
}

Presence constant_stiffness(const Study& s) {
    return constant_profile(s)
               ? Presence{Need::required, "gearbox.tooth_profile is \"constant\"",
                          "gearbox.tooth_profile"}
               : Presence{Need::forbidden,
                          "only for gearbox.tooth_profile = \"constant\": the teeth give it",
                          "gearbox.tooth_profile"};
}

Presence inertia(const Study& s) {
    return s.gearbox.has_teeth() && s.gearbox.module_m
               ? Presence{Need::optional, "", ""}
               : Presence{Need::forbidden, "its radius is unknown without tooth numbers and module",
                          "gearbox.tooth_profile"};
}

Presence inertia_over_r2(const Study& s) {
    return constant_profile(s) && !s.gearbox.has_teeth()
               ? Presence{Need::required, "without tooth numbers no disc can be assumed",
                          "gearbox.tooth_profile"}
               : Presence{Need::optional, "", ""};
}

Presence bearing(const Study& s) {
    return s.effects.motion == Motion::torsional
               ? Presence{Need::optional, "", ""}
               : Presence{Need::required, "effects.motion is \"translational-torsional\"",
                          "effects.motion"};
}

Presence damping_ratio(const Study& s) {
    return damping(s, MeshDamping::ratio, "effects.mesh_damping = \"ratio\" goes with it");
}
Presence damping_time(const Study& s) {
    return damping(s, MeshDamping::proportional,
                   "effects.mesh_damping = \"proportional\" goes with it");
}
Presence damping_constant(const Study& s) {
    return damping(s, MeshDamping::constant, "effects.mesh_damping = \"constant\" goes with it");
}

Presence crack(const Study& s) {
    return s.fault.kind == FaultKind::crack
               ? Presence{Need::required, "fault.kind is \"crack\"", "fault.kind"}
               : Presence{Need::optional, "", ""};
}

Presence planet_side(const Study& s) {
    if (planet_crack(s)) {
        return {Need::required, "fault.member is \"planet\"", "fault.member"};
    }
    return planet_number(s);
}

Presence planet_number(const Study& s) {
    return s.fault.kind == FaultKind::none || planet_crack(s)
               ? Presence{Need::optional, "", ""}
               : Presence{Need::forbidden, "only for fault.member = \"planet\"", "fault.member"};
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
