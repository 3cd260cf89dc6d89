// Checks of the gears: possible shapes, meshing, assembly and gear bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gears/mesh_geometry.hpp"
#include "gears/planetary.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

std::string teeth_key(Member member) {
    return member_key(member, "teeth");
}

std::vector<Member> toothed_members(const Study& study) {
    std::vector<Member> members;
    for (const MeshMembers& mesh : meshes_of(study.gearbox.kind)) {
        if (members.empty() || members.back() != mesh.member_1) {
            members.push_back(mesh.member_1);
        }
        members.push_back(mesh.member_2);
    }
    return members;
}

bool teeth_usable(const StudyDraft& draft) {
    for (const Member member : toothed_members(draft.study)) {
        if (!draft.all_usable({teeth_key(member)})) {
            return false;
        }
    }
    return draft.usable("gearbox.kind");
}

namespace {

using std::numbers::pi;

void check_positions(StudyDraft& draft, int planets) {
    const std::string key = "gearbox.planet_positions_deg";
    const std::vector<double>& positions = draft.study.gearbox.planet_positions_rad;
    if (static_cast<int>(positions.size()) != planets) {
        draft.reject(
            key,
            fmt::format("has {} positions, but there are {} planets", positions.size(), planets),
            "give one angle for each planet, or leave the key out for equal spacing");
    } else if (positions.front() != 0.0) {
        draft.reject(key, "does not begin with 0 (angles count from the first planet)",
                     "subtract the first position from all of them");
    }
}

// Rejects positions at which a planet cannot be assembled. Planet n fits where (Z_s + Z_r) psi_n /
// 2 pi is an integer, Parker and Lin (2004).
void check_positions_fit(StudyDraft& draft, const gears::PlanetaryTrain& train) {
    constexpr double kSameAngle = 1e-3;  // relative to the angle between two possible positions
    const double places = train.sun_teeth + train.ring_teeth;
    for (const double position : draft.study.gearbox.planet_positions_rad) {
        const double place = position * places / (2.0 * pi);
        if (std::abs(place - std::round(place)) > kSameAngle) {
            draft.reject(
                "gearbox.planet_positions_deg",
                fmt::format("a planet at {:.6g} deg does not mesh (positions are multiples "
                            "of 360 / (sun + ring teeth) = {:.6g} deg)",
                            position * 180.0 / pi, 360.0 / places),
                fmt::format("the nearest one is {:.9g}", std::round(place) * 360.0 / places));
        }
    }
}

// Moves planets that cannot be equally spaced to the nearest positions at which they mesh.
void place_planets(StudyDraft& draft) {
    Gearbox& g = draft.study.gearbox;
    const gears::PlanetaryTrain train{*g.bodies[Member::sun].teeth, *g.bodies[Member::planet].teeth,
                                      *g.bodies[Member::ring].teeth, g.planets};
    if (g.planet_positions_rad.empty() && draft.usable("gearbox.planet_positions_deg") &&
        (train.sun_teeth + train.ring_teeth) % train.planets != 0) {
        g.planet_positions_rad = gears::nearest_positions(train);
    }
}

std::vector<std::string> assembly_problems(const StudyDraft& draft,
                                           const gears::PlanetaryTrain& train) {
    const Study& s = draft.study;
    if (shift_given(s) && has_gears(s)) {
        return draft.all_usable(shift_keys()) && draft.usable("gearbox.module_mm")
                   ? gears::assembly_problems(train, planet_dimensions(s))
                   : std::vector<std::string>{};
    }
    return gears::assembly_problems(train, s.gearbox.addendum_coefficient);
}

void check_train(StudyDraft& draft) {
    const Gearbox& g = draft.study.gearbox;
    if (g.kind != GearboxKind::planetary || !teeth_usable(draft)) {
        return;
    }
    const bool planets_known = draft.all_usable({"gearbox.planets"}) && g.planets >= 1;
    const bool placed = !g.planet_positions_rad.empty() &&
                        draft.all_usable({"gearbox.planet_positions_deg"}) && planets_known;
    if (placed) {
        check_positions(draft, g.planets);
    }
    const auto teeth = [&](Member member) { return g.bodies[member].teeth; };
    const int given = int{teeth(Member::sun).has_value()} + int{teeth(Member::planet).has_value()} +
                      int{teeth(Member::ring).has_value()};
    if (given == 1 || given == 2) {
        draft.reject("gearbox", "some tooth numbers are missing",
                     "give the teeth of sun, planet and ring, or none of them");
    }
    if (given != 3 || !draft.all_usable({"gearbox.addendum_coefficient"}) || !planets_known) {
        return;
    }
    place_planets(draft);
    const gears::PlanetaryTrain all{*teeth(Member::sun), *teeth(Member::planet),
                                    *teeth(Member::ring), g.planets, g.planet_positions_rad};
    // Planets at given positions are checked one by one.
    gears::PlanetaryTrain train = all;
    if (placed) {
        train.planets = 1;
        train.positions_rad.clear();
    }
    const auto problems = assembly_problems(draft, train);
    // A ring that does not fit between the others is the first of them.
    const int fitting = train.sun_teeth + 2 * train.planet_teeth;
    const bool too_wide = !shift_given(draft.study) && train.ring_teeth != fitting;
    for (std::size_t i = 0; i < problems.size(); ++i) {
        const std::string what = "the gears cannot be assembled: " + problems[i];
        if (i == 0 && too_wide) {
            draft.reject("gearbox.ring.teeth", what,
                         fmt::format("use {} teeth, or give profile shifts", fitting));
        } else {
            draft.reject("gearbox.planets", what, "use another number of planets or teeth");
        }
    }
    if (placed && problems.empty()) {
        check_positions_fit(draft, train);
    }
    if (placed && problems.empty() && draft.usable("gearbox.planet_positions_deg")) {
        for (const std::string& what : assembly_problems(draft, all)) {
            draft.reject("gearbox.planet_positions_deg", what, "");
        }
    }
}

// Key named in the message about two gears that do not mesh: the centre distance or the first given
// shift, else a pressure angle below the standard one, else the smaller gear's number of teeth.
std::string mesh_key(const StudyDraft& draft, const MeshMembers& mesh, const gears::Gear& gear_1,
                     const gears::Gear& gear_2) {
    for (const std::string& key : shift_keys()) {
        if (draft.is_given(key)) {
            return key;
        }
    }
    constexpr double kStandardAngle = 20.0 * pi / 180.0;
    const Member smaller = gear_2.teeth < gear_1.teeth ? mesh.member_2 : mesh.member_1;
    return gear_1.pressure_angle_rad < kStandardAngle * (1.0 - 1e-12) ? "gearbox.pressure_angle_deg"
                                                                      : teeth_key(smaller);
}

// Rejects two gears that are possible on their own but do not mesh.
void check_mesh(StudyDraft& draft, const MeshMembers& mesh) {
    const gears::Gear gear_1 = gear_of(draft.study, mesh.member_1);
    const gears::Gear gear_2 = gear_of(draft.study, mesh.member_2);
    if (!gears::gear_problems(gear_1).empty() || !gears::gear_problems(gear_2).empty()) {
        return;
    }
    const std::string key = mesh_key(draft, mesh, gear_1, gear_2);
    const auto distance = working_shifts(draft.study).centre_distance_m;
    for (const std::string& what : gears::mesh_problems(gear_1, gear_2, distance)) {
        draft.reject(key,
                     fmt::format("{} and {} do not mesh ({})", member_name(mesh.member_1),
                                 member_name(mesh.member_2), what),
                     "");
        draft.problems.back().kind = ProblemKind::meshing;
    }
}

// Rejects backlash where the given shifts and the centre distance overdetermine a mesh. Backlash
// counts as intended if both shifts of the mesh and the distance are given, unless it is more than
// any allowance of tooth thickness: then they contradict each other.
void check_backlash(StudyDraft& draft, const MeshMembers& mesh) {
    // Modules: the effect of shifts rounded to two decimals, and of a coarse allowance.
    constexpr double kRounded = 0.01, kIntended = 0.25;
    const Study& s = draft.study;
    const std::optional<double>& given_1 = s.gearbox.bodies[mesh.member_1].profile_shift;
    const std::optional<double>& given_2 = s.gearbox.bodies[mesh.member_2].profile_shift;
    if (!given_1 && !given_2) {
        return;
    }
    const bool intended = given_1 && given_2 && s.gearbox.centre_distance_m;
    const gears::Gear gear_1 = gear_of(s, mesh.member_1), gear_2 = gear_of(s, mesh.member_2);
    const double distance = centre_distance_m(s);
    const double backlash = gears::MeshGeometry(gear_1, gear_2, distance).backlash();
    if (backlash <= (intended ? kIntended : kRounded) * gear_1.module_m) {
        return;
    }
    const Member changed = given_2 ? mesh.member_2 : mesh.member_1;
    const double other = (given_2 ? gear_1 : gear_2).profile_shift;
    const bool ring = mesh.member_2 == Member::ring;
    draft.reject(
        member_key(changed, "shift"),
        fmt::format("leaves {:.4f} mm of backlash between {} and {} at a centre distance of {:.6g} "
                    "mm (a shift of {:.4f} leaves none)",
                    kMmPerM * backlash, ring ? "planets" : member_name(mesh.member_1),
                    ring                              ? "ring"
                    : mesh.member_2 == Member::planet ? "planets"
                                                      : member_name(mesh.member_2),
                    kMmPerM * distance,
                    (gears::tight_shift_sum(gear_1, gear_2, distance) - other) /
                        normal_over_transverse(s.gearbox)),
        intended ? fmt::format("correct the shifts or the centre distance; up to {:g} mm of "
                               "backlash can be meant",
                               kIntended * kMmPerM * gear_1.module_m)
                 : "give that one, or none; if the backlash is meant, give the shift of the "
                   "planets and centre_distance_mm as well");
}

// Rejects a relief of a gear that is longer than its path of contact in that mesh.
void check_relief(StudyDraft& draft, const gears::MeshGeometry& mesh, Member member) {
    const double length_mm = kMmPerM * relief_of(draft.study, member).tip_length_m;
    const double path_mm = kMmPerM * mesh.contact_ratio() * mesh.base_pitch();
    if (length_mm > path_mm) {
        draft.reject(member_key(member, "tip_relief_length_mm"),
                     fmt::format("{:.6g} mm is more than the length of contact, {:.6g} mm",
                                 length_mm, path_mm),
                     "give a shorter relief");
    }
}

void check_reliefs(StudyDraft& draft) {
    for (const MeshMembers& mesh : meshes_of(draft.study.gearbox.kind)) {
        const gears::MeshGeometry geometry(gear_of(draft.study, mesh.member_1),
                                           gear_of(draft.study, mesh.member_2),
                                           working_shifts(draft.study).centre_distance_m);
        check_relief(draft, geometry, mesh.member_1);
        check_relief(draft, geometry, mesh.member_2);
    }
}

// Rejects a centre distance that makes gears impossible which are possible without it. False if it
// did.
bool check_centre_distance(StudyDraft& draft) {
    const auto impossible = [](const Study& study) {
        return std::ranges::any_of(toothed_members(study), [&](Member member) {
            return !gears::gear_problems(gear_of(study, member)).empty();
        });
    };
    Study without = draft.study;
    without.gearbox.centre_distance_m.reset();
    if (!draft.study.gearbox.centre_distance_m || !impossible(draft.study) || impossible(without)) {
        return true;
    }
    const MeshMembers mesh = meshes_of(without.gearbox.kind).front();
    const double given = *draft.study.gearbox.centre_distance_m,
                 base = gears::base_centre_distance(gear_of(without, mesh.member_1),
                                                    gear_of(without, mesh.member_2));
    draft.reject(
        "gearbox.centre_distance_mm",
        fmt::format(
            "{:.6g} mm {}", kMmPerM * given,
            given <= base
                ? fmt::format("is no more than that of the base circles, {:.6g} mm", kMmPerM * base)
                : "needs profile shifts with which no gears are possible"),
        fmt::format("the other keys give {:.6g} mm; correct it, or them",
                    kMmPerM * centre_distance_m(without)));
    return false;
}

// Where the stiffness is given, the teeth need not be geometrically possible.
void check_gear_shapes(StudyDraft& draft) {
    if (stiffness_given(draft.study) || !teeth_usable(draft) || !has_gears(draft.study) ||
        !draft.all_usable({"gearbox.module_mm", "gearbox.pressure_angle_deg",
                           "gearbox.addendum_coefficient", "gearbox.dedendum_coefficient",
                           "gearbox.tooth_profile"}) ||
        !draft.all_usable(shift_keys()) || !check_centre_distance(draft)) {
        return;
    }
    const std::size_t before = draft.problems.size();
    for (const Member member : toothed_members(draft.study)) {
        for (const std::string& what : gears::gear_problems(gear_of(draft.study, member))) {
            draft.reject(teeth_key(member), "the gear is not possible (" + what + ")", "");
        }
    }
    for (const MeshMembers& mesh : meshes_of(draft.study.gearbox.kind)) {
        check_mesh(draft, mesh);
    }
    // Contact below the base circle is reported first; it makes the undercut message redundant.
    if (draft.problems.size() == before) {
        for (const MeshMembers& mesh : meshes_of(draft.study.gearbox.kind)) {
            check_backlash(draft, mesh);
        }
        check_reliefs(draft);
        for (const Member member : toothed_members(draft.study)) {
            for (const std::string& what : gears::undercut_problems(gear_of(draft.study, member))) {
                draft.reject(teeth_key(member), "the gear cannot be cut (" + what + ")", "");
            }
        }
    }
}

void check_body(StudyDraft& draft, Member member, const std::optional<double>& diameter_m) {
    const bool ring = member == Member::ring;
    const std::string key = member_key(member, ring ? "outer_mm" : "bore_mm");
    if (!diameter_m || !draft.all_usable({key})) {
        return;
    }
    const double root_mm = 2.0 * kMmPerM * gear_of(draft.study, member).root_radius();
    const double given_mm = *diameter_m * kMmPerM;
    if (ring ? given_mm <= root_mm : given_mm >= root_mm) {
        draft.reject(key,
                     fmt::format("{:.6g} mm leaves no body under the teeth (the root circle's "
                                 "diameter is {:.6g} mm)",
                                 given_mm, root_mm),
                     ring ? "give a larger outer diameter" : "give a smaller bore");
    }
}

// Rejects rims that leave no web between them and the bore.
void check_blank(StudyDraft& draft, Member member) {
    const MemberValues& body = draft.study.gearbox.bodies[member];
    const std::string key = member_key(member, "rim_mm");
    if (!body.rim_m || !body.held_diameter_m || !draft.all_usable({key})) {
        return;
    }
    const double body_mm =
        kMmPerM * (gear_of(draft.study, member).root_radius() - 0.5 * *body.held_diameter_m);
    const double given_mm = *body.rim_m * kMmPerM;
    if (body_mm > 0.0 && given_mm >= body_mm) {
        draft.reject(key,
                     fmt::format("{:.6g} mm leaves no room for the web (the gear body is {:.6g} mm "
                                 "thick from the root circle to the bore)",
                                 given_mm, body_mm),
                     "give a thinner rim; for a solid gear body remove the keys of rim and web");
    }
}

void check_bodies(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!teeth_usable(draft) || !has_gears(s) ||
        !draft.all_usable({"gearbox.module_mm", "gearbox.dedendum_coefficient"}) ||
        !draft.all_usable(shift_keys())) {
        return;
    }
    for (const Member member : toothed_members(s)) {
        check_body(draft, member, s.gearbox.bodies[member].held_diameter_m);
        check_blank(draft, member);
    }
}

// Checks the levels of a square wave and the phases of a static transmission error.
void check_mesh_values(StudyDraft& draft, MeshKind mesh) {
    const MeshValues& given = draft.study.gearbox.meshes[mesh];
    const std::string table = fmt::format("gearbox.{}.", mesh_table(mesh));
    const auto &low = given.low_stiffness_N_m, &high = given.high_stiffness_N_m;
    const std::string low_key = table + "low_stiffness_N_m",
                      high_key = table + "high_stiffness_N_m";
    if (low && high && draft.all_usable({low_key, high_key}) && *low > *high) {
        draft.reject(low_key,
                     fmt::format("{} N/m is above the high stiffness, {} N/m", *low, *high),
                     "swap the two values");
    }
    const std::size_t amplitudes = given.error_m.size(), phases = given.error_phase_rad.size();
    const std::string phase_key = table + "error_phase_deg";
    if (phases > 0 && phases != amplitudes && draft.all_usable({table + "error_um", phase_key})) {
        draft.reject(phase_key,
                     fmt::format("has {} phases for {} amplitudes in error_um", phases, amplitudes),
                     "give one phase for each amplitude, or none");
    }
}

void check_given_stiffness(StudyDraft& draft) {
    const Gearbox& g = draft.study.gearbox;
    if (g.kind == GearboxKind::fixed_shaft && stiffness_given(draft.study) &&
        draft.all_usable({"gearbox.kind", "gearbox.tooth_profile"})) {
        draft.reject("gearbox.tooth_profile",
                     fmt::format("\"{}\" is only for gearbox.kind = \"planetary\"",
                                 choice_text(draft.study, "gearbox", "tooth_profile")),
                     "use a profile from which the stiffness is computed");
    }
}

// Checks of deviations from the ideal gearbox: planets, tooth deviations and transmission errors.

void check_planet_lists(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.gearbox.kind != GearboxKind::planetary || !draft.usable("gearbox.planets")) {
        return;
    }
    const PlanetDifferences& p = s.planets;
    for (const auto& [key, list] : {std::pair{"gearbox.pin_tangential_um", &p.pin_tangential_m},
                                    std::pair{"gearbox.pin_radial_um", &p.pin_radial_m}}) {
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
        check_teeth_listed(draft, member_key(member, "index_um"), body.index_m, teeth_key(member),
                           teeth);
        check_teeth_listed(draft, member_key(member, "ring_side_index_um"), body.ring_side_index_m,
                           teeth_key(member), teeth);
    }
}

}  // namespace

void check_gears(StudyDraft& draft) {
    check_train(draft);
    check_gear_shapes(draft);
    check_bodies(draft);
    check_mesh_values(draft, MeshKind::sun_planet);
    check_mesh_values(draft, MeshKind::ring_planet);
    check_given_stiffness(draft);
    check_tooth_errors(draft);
}

void check_tooth_errors(StudyDraft& draft) {
    check_planet_lists(draft);
    check_measured_teeth(draft);
}

}  // namespace gearpod::mc
