// Checks of deviations from the ideal gearbox: planets, tooth deviations and transmission errors.
#include <fmt/format.h>

#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {
namespace {

void check_phases(StudyDraft& draft, const std::string& mesh, const std::vector<double>& error,
                  const std::vector<double>& phase) {
    const std::string error_key = fmt::format("gearbox.{}_error_um", mesh),
                      phase_key = fmt::format("gearbox.{}_error_phase_deg", mesh);
    if (!phase.empty() && phase.size() != error.size() &&
        draft.all_usable({error_key, phase_key})) {
        draft.reject(phase_key,
                     fmt::format("has {} phases for {} amplitudes in {}_error_um", phase.size(),
                                 error.size(), mesh),
                     "give one phase for each amplitude, or none");
    }
}

// Checks lists that have one value for each planet.
void check_planet_lists(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.gearbox.kind != GearboxKind::planetary || !draft.usable("gearbox.planets")) {
        return;
    }
    const PlanetDifferences& p = s.planets;
    for (const auto& [key, list] :
         {std::pair{"gearbox.pin_tangential_um", &p.pin_tangential_m},
          std::pair{"gearbox.pin_radial_um", &p.pin_radial_m},
          std::pair{"gearbox.planet_bearing_stiffness_factors", &p.bearing_stiffness},
          std::pair{"gearbox.planet_bearing_damping_factors", &p.bearing_damping},
          std::pair{"gearbox.planet_mass_factors", &p.mass}}) {
        if (!list->empty() && static_cast<int>(list->size()) != s.gearbox.planets) {
            draft.reject(key,
                         fmt::format("has {} values, but there are {} planets", list->size(),
                                     s.gearbox.planets),
                         "give one for each planet, or leave the key out");
        }
    }
}

void check_teeth_listed(StudyDraft& draft, const std::string& key, const std::vector<double>& list,
                        const std::string& teeth_key, int teeth) {
    if (!list.empty() && static_cast<int>(list.size()) != teeth &&
        draft.all_usable({key, teeth_key, "gearbox.planets"})) {
        draft.reject(key, fmt::format("has {} deviations for {} teeth", list.size(), teeth),
                     "give one for each tooth; for planets, one planet after the other");
    }
}

// Checks measured deviations, one for each tooth.
void check_measured_teeth(StudyDraft& draft) {
    if (!teeth_usable(draft)) {
        return;
    }
    for (const Member member : toothed_members(draft.study)) {
        const MemberValues& body = draft.study.gearbox.bodies[member];
        const int gears = member == Member::planet ? draft.study.gearbox.planets : 1;
        const int teeth = gears * teeth_of(draft.study, member).value_or(0);
        const std::string name(member_name(member));
        check_teeth_listed(draft, "gearbox." + name + "_index_um", body.index_m, teeth_key(member),
                           teeth);
        check_teeth_listed(draft, "gearbox." + name + "_ring_side_index_um", body.ring_side_index_m,
                           teeth_key(member), teeth);
    }
}

}  // namespace

void check_tooth_errors(StudyDraft& draft) {
    check_planet_lists(draft);
    check_measured_teeth(draft);
    const MeshErrors& e = draft.study.errors;
    check_phases(draft, "sun_planet", e.sun_planet_m, e.sun_planet_phase_rad);
    check_phases(draft, "ring_planet", e.ring_planet_m, e.ring_planet_phase_rad);
    check_phases(draft, "mesh", e.mesh_m, e.mesh_phase_rad);
}

}  // namespace gearpod::mc
