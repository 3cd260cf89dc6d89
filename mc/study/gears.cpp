#include "mc/study/gears.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "dynamics/helical_pair.hpp"
#include "machine/contracts.hpp"
#include "stiffness/iso_6336.hpp"

namespace gearpod::mc {
namespace {

constexpr std::array kPlanetaryMeshes{
    MeshMembers{MeshKind::sun_planet, Member::sun, Member::planet},
    MeshMembers{MeshKind::ring_planet, Member::planet, Member::ring}};
constexpr std::array kFixedShaftMeshes{
    MeshMembers{MeshKind::pinion_gear, Member::pinion, Member::gear}};

bool any_random(const Study& study, std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys,
                               [&](const char* key) { return study.find_random(key) != nullptr; });
}

gears::Gear standard_gear(const Study& study, Member member) {
    const Gearbox& gearbox = study.gearbox;
    gears::Gear gear;
    gear.teeth = teeth_of(study, member).value();
    gear.internal = member == Member::ring;
    gear.module_m = gearbox.transverse_module_m().value();
    gear.pressure_angle_rad = transverse_pressure_angle_rad(gearbox);
    gear.addendum_coefficient = gearbox.addendum_coefficient * normal_over_transverse(gearbox);
    gear.dedendum_coefficient = gearbox.dedendum_coefficient * normal_over_transverse(gearbox);
    return gear;
}

// Pinion and gear of a fixed-shaft gearbox, or sun and planet.
std::pair<Member, Member> shifted_pair(const Study& study) {
    const MeshMembers& mesh = meshes_of(study.gearbox.kind).front();
    return {mesh.member_1, mesh.member_2};
}

std::vector<FaultPlace> places_on_planet(FaultSide side) {
    switch (side) {
        case FaultSide::sun:
            return {{0, 2}};
        case FaultSide::ring:
            return {{1, 1}};
        case FaultSide::both:
            return {{0, 2}, {1, 1}};
    }
    return {};
}

}  // namespace

std::string_view member_name(Member member) {
    switch (member) {
        case Member::sun:
            return "sun";
        case Member::planet:
            return "planet";
        case Member::ring:
            return "ring";
        case Member::carrier:
            return "carrier";
        case Member::pinion:
            return "pinion";
        case Member::gear:
            return "gear";
    }
    return "";
}

std::string member_key(Member member, std::string_view label) {
    return fmt::format("gearbox.{}.{}", member_name(member), label);
}

std::string_view mesh_table(MeshKind mesh) {
    switch (mesh) {
        case MeshKind::sun_planet:
            return "sun_planet";
        case MeshKind::ring_planet:
            return "ring_planet";
        case MeshKind::pinion_gear:
            return "mesh";
    }
    return "";
}

bool has_shaft(GearboxKind kind, Member shaft) {
    return (kind == GearboxKind::fixed_shaft) == (shaft == Member::pinion || shaft == Member::gear);
}

std::string use_shafts_text(GearboxKind kind) {
    return kind == GearboxKind::fixed_shaft ? "use \"pinion\" or \"gear\""
                                            : "use \"sun\", \"ring\" or \"carrier\"";
}

std::span<const MeshMembers> meshes_of(GearboxKind kind) {
    if (kind == GearboxKind::fixed_shaft) {
        return kFixedShaftMeshes;
    }
    return kPlanetaryMeshes;
}

std::string mesh_name(const MeshMembers& mesh) {
    const bool ring = mesh.member_2 == Member::ring;
    const std::string first(member_name(ring ? mesh.member_2 : mesh.member_1));
    return first + "-" + std::string(member_name(ring ? mesh.member_1 : mesh.member_2));
}

bool has_toothed_member(GearboxKind kind, Member member) {
    const auto meshes = meshes_of(kind);
    return std::ranges::any_of(meshes, [&](const MeshMembers& mesh) {
        return mesh.member_1 == member || mesh.member_2 == member;
    });
}

std::optional<int> teeth_of(const Study& study, Member member) {
    return study.gearbox.bodies[member].teeth;
}

bool has_static_errors(const Study& study) {
    return std::ranges::any_of(study.gearbox.meshes.values,
                               [](const MeshValues& mesh) { return !mesh.error_m.empty(); });
}

dynamics::MeshLaw mesh_law(const Study& study) {
    if (has_unilateral_teeth(study)) {
        return dynamics::MeshLaw::unilateral;
    }
    if (study.effects.separation != Separation::none) {
        return dynamics::MeshLaw::separating;
    }
    return has_static_errors(study) ? dynamics::MeshLaw::with_error : dynamics::MeshLaw::linear;
}

bool teeth_can_separate(const Study& study) {
    return dynamics::separates(mesh_law(study));
}

bool has_tooth_quality(const Study& study) {
    return study.errors.tooth_quality || std::ranges::any_of(kAllMembers, [&](Member member) {
               return study.gearbox.bodies[member].quality.has_value();
           });
}

bool has_measured_teeth(const Study& study) {
    return std::ranges::any_of(kAllMembers, [&](Member member) {
        const MemberValues& body = study.gearbox.bodies[member];
        return !body.index_m.empty() || !body.ring_side_index_m.empty();
    });
}

bool has_tooth_errors(const Study& study) {
    const ToothErrors& e = study.errors;
    return has_tooth_quality(study) || has_measured_teeth(study) || e.pitch_error_m > 0.0 ||
           e.eccentricity_m > 0.0 ||
           any_random(study, {"gearbox.pitch_error_um", "gearbox.eccentricity_um"});
}

bool has_random_planets(const Study& study) {
    const PlanetDifferences& p = study.planets;
    return p.pin_tangential_rms_m > 0.0 || p.pin_radial_rms_m > 0.0 ||
           any_random(study, {"gearbox.pin_tangential_rms_um", "gearbox.pin_radial_rms_um"});
}

bool has_unequal_planets(const Study& study) {
    const PlanetDifferences& p = study.planets;
    return has_random_planets(study) || !p.pin_tangential_m.empty() || !p.pin_radial_m.empty();
}

bool stiffness_given(const Study& study) {
    return study.gearbox.tooth_profile == StiffnessSource::constant ||
           study.gearbox.tooth_profile == StiffnessSource::square_wave;
}

bool has_gears(const Study& study) {
    const auto meshes = meshes_of(study.gearbox.kind);
    return study.gearbox.transverse_module_m() &&
           std::ranges::all_of(meshes, [&](const MeshMembers& mesh) {
               return teeth_of(study, mesh.member_1) && teeth_of(study, mesh.member_2);
           });
}

double transverse_pressure_angle_rad(const Gearbox& gearbox) {
    return gearbox.helix_angle_rad == 0.0
               ? gearbox.pressure_angle_rad
               : dynamics::transverse_pressure_angle(gearbox.pressure_angle_rad,
                                                     gearbox.helix_angle_rad);
}

double normal_over_transverse(const Gearbox& gearbox) {
    return std::cos(gearbox.helix_angle_rad);
}

bool shift_given(const Study& study) {
    return study.gearbox.centre_distance_m || std::ranges::any_of(kAllMembers, [&](Member member) {
               return study.gearbox.bodies[member].profile_shift.has_value();
           });
}

std::vector<std::string> shift_keys() {
    std::vector<std::string> keys{"gearbox.centre_distance_mm"};
    for (const Member member : kAllMembers) {
        if (member != Member::carrier) {
            for (const char* what : {"shift", "tip_mm"}) {
                keys.push_back(member_key(member, what));
            }
        }
    }
    return keys;
}

gears::WorkingShifts working_shifts(const Study& study) {
    if (!shift_given(study)) {
        return {};
    }
    EXPECTS(has_gears(study));
    const Gearbox& g = study.gearbox;
    const auto [first, second] = shifted_pair(study);
    const auto transverse = [&](Member member) {
        std::optional<double> shift = g.bodies[member].profile_shift;
        if (shift) {
            *shift *= normal_over_transverse(g);
        }
        return shift;
    };
    const gears::SpecifiedShifts specified{transverse(first), transverse(second),
                                           transverse(Member::ring), g.centre_distance_m};
    const gears::Gear gear_1 = standard_gear(study, first), gear_2 = standard_gear(study, second);
    if (g.kind == GearboxKind::fixed_shaft) {
        return gears::working_shifts(gear_1, gear_2, nullptr, specified);
    }
    const gears::Gear ring = standard_gear(study, Member::ring);
    return gears::working_shifts(gear_1, gear_2, &ring, specified);
}

gears::Gear gear_of(const Study& study, Member member) {
    EXPECTS(teeth_of(study, member) && study.gearbox.transverse_module_m());
    gears::Gear gear = standard_gear(study, member);
    if (shift_given(study) && has_gears(study)) {
        const gears::WorkingShifts set = working_shifts(study);
        const bool ring = member == Member::ring;
        gear.profile_shift = ring                                  ? set.ring
                             : member == shifted_pair(study).first ? set.first
                                                                   : set.second;
        gear.tip_shortening = ring ? 0.0 : set.tip_shortening;
    }
    if (const auto& tip = study.gearbox.bodies[member].tip_diameter_m) {
        gear.given_tip_radius_m = 0.5 * *tip;
    }
    return gear;
}

double centre_distance_m(const Study& study) {
    const auto [first, second] = shifted_pair(study);
    const double standard = 0.5 * study.gearbox.transverse_module_m().value() *
                            (teeth_of(study, first).value() + teeth_of(study, second).value());
    return working_shifts(study).centre_distance_m.value_or(standard);
}

gears::PlanetDimensions planet_dimensions(const Study& study) {
    EXPECTS(shift_given(study));
    const double module = study.gearbox.transverse_module_m().value();
    return {centre_distance_m(study) / module,
            2.0 * gear_of(study, Member::planet).tip_radius() / module};
}

gears::FlankRelief relief_of(const Study& study, Member member) {
    const MemberValues& given = study.gearbox.bodies[member];
    return {given.tip_relief_m.value_or(0.0), given.tip_relief_length_m.value_or(0.0),
            given.crowning_m.value_or(0.0)};
}

bool has_relief(const Study& study) {
    return std::ranges::any_of(kAllMembers,
                               [&](Member member) { return relief_of(study, member).any(); });
}

bool has_flank_gaps(const Study& study) {
    return has_relief(study) || study.effects.contact_onset == ContactOnset::extended;
}

bool has_unilateral_teeth(const Study& study) {
    return has_tooth_errors(study) || has_flank_gaps(study);
}

double working_angle_rad(const Study& study, MeshKind mesh) {
    const auto distance = working_shifts(study).centre_distance_m;
    if (!distance) {
        return transverse_pressure_angle_rad(study.gearbox);
    }
    const bool ring = mesh == MeshKind::ring_planet;
    const auto [first, second] = shifted_pair(study);
    return gears::working_angle_at(gear_of(study, ring ? Member::planet : first),
                                   gear_of(study, ring ? Member::ring : second), *distance);
}

stiffness::Profile profile_of(const Study& study) {
    switch (study.gearbox.tooth_profile) {
        case StiffnessSource::base_circle:
            return stiffness::Profile::base_circle;
        case StiffnessSource::fillet:
            return stiffness::Profile::fillet;
        case StiffnessSource::root_circle:
        case StiffnessSource::constant:
        case StiffnessSource::square_wave:
            return stiffness::Profile::root_circle;
    }
    return stiffness::Profile::root_circle;
}

double blank_factor(const Study& study, Member member) {
    const Gearbox& g = study.gearbox;
    const MemberValues& body = g.bodies[member];
    if (!body.rim_m || !body.web_m) {
        return 1.0;
    }
    const double normal_module_m = g.transverse_module_m().value() * normal_over_transverse(g);
    return stiffness::gear_blank_factor(*body.web_m / g.face_width_m.value(),
                                        *body.rim_m / normal_module_m);
}

double blank_factor(const Study& study, const MeshMembers& mesh) {
    return std::min(blank_factor(study, mesh.member_1), blank_factor(study, mesh.member_2));
}

stiffness::Material material_of(const Study& study, const MeshMembers& mesh) {
    const Gearbox& g = study.gearbox;
    EXPECTS(g.young_modulus_Pa && g.poisson_ratio && g.face_width_m);
    stiffness::Material material{g.young_modulus_Pa.value() * blank_factor(study, mesh),
                                 g.poisson_ratio.value(), g.face_width_m.value(),
                                 study.effects.shear};
    stiffness::set_helix(g.helix_angle_rad, g.pressure_angle_rad, material);
    return material;
}

double overlap_ratio(const Study& study) {
    const Gearbox& g = study.gearbox;
    return g.face_width_m.value() * std::tan(g.helix_angle_rad) /
           (std::numbers::pi * g.transverse_module_m().value());
}

std::vector<FaultPlace> fault_places(const Fault& fault) {
    switch (fault.member.value()) {
        case Member::planet:
            return places_on_planet(fault.side);
        case Member::ring:
            return {{1, 2}};
        case Member::gear:
            return {{0, 2}};
        case Member::sun:
        case Member::pinion:
            return {{0, 1}};
        case Member::carrier:
            return {};
    }
    return {};
}

}  // namespace gearpod::mc
