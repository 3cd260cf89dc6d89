// Keys of [gearbox].
#include <fmt/format.h>

#include <string>
#include <vector>

#include "mc/study/gears.hpp"
#include "mc/study/keys/schema_line.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kKinds[] = {name("planetary", GearboxKind::planetary),
                                 name("fixed-shaft", GearboxKind::fixed_shaft)};
constexpr ChoiceName kProfiles[] = {
    name("root-circle", StiffnessSource::root_circle),
    name("base-circle", StiffnessSource::base_circle), name("fillet", StiffnessSource::fillet),
    name("constant", StiffnessSource::constant), name("square-wave", StiffnessSource::square_wave)};

using G = Gearbox;
using F = FixedShaft;
using E = ToothErrors;
using P = PlanetDifferences;
using B = MemberValues;
using M = MeshValues;

// Description of a key that several members or meshes have, each in its own table.
template <class Which, std::size_t kCount>
struct SharedKey {
    std::string_view label;
    std::span<const Which> owners;
    std::array<AnyAccess, kCount> access;
    Unit unit;
    Range range;
    Presence (*presence)(const Study&, Which);
    std::string_view fixed_because;
    std::string_view doc;  // {} stands for the member or mesh
};
using MemberKey = SharedKey<Member, kAllMembers.size()>;
using MeshKey = SharedKey<MeshKind, kMeshKinds>;

constexpr Member kPlanetary[] = {Member::sun, Member::planet, Member::ring, Member::carrier};
constexpr Member kPairGears[] = {Member::pinion, Member::gear};
constexpr Member kGears[] = {Member::sun, Member::planet, Member::ring, Member::pinion,
                             Member::gear};
constexpr Member kBored[] = {Member::sun, Member::planet, Member::pinion, Member::gear};
constexpr Member kRing[] = {Member::ring};
// One gear of each mesh: crowning of both adds.
constexpr Member kCrowned[] = {Member::sun, Member::ring, Member::gear};
// Gears that may have another grade than tooth_quality.
constexpr Member kGraded[] = {Member::planet, Member::ring, Member::gear};
// A web may carry planets; all other gears are solid.
constexpr Member kPlanet[] = {Member::planet};
constexpr MeshKind kPlanetMeshes[] = {MeshKind::sun_planet, MeshKind::ring_planet};
constexpr MeshKind kRingMesh[] = {MeshKind::ring_planet};

// Rule that is the same for all owners of a key.
template <class Which, Presence (*Rule)(const Study&)>
Presence same(const Study& s, Which) {
    return Rule(s);
}
template <Presence (*Rule)(const Study&)>
constexpr auto each = same<Member, Rule>;
template <Presence (*Rule)(const Study&)>
constexpr auto mesh = same<MeshKind, Rule>;

std::string_view table_of(Member member) {
    return member_name(member);
}
std::string_view table_of(MeshKind mesh) {
    return mesh_table(mesh);
}
GearboxKind kind_of(Member member) {
    return member == Member::pinion || member == Member::gear ? GearboxKind::fixed_shaft
                                                              : GearboxKind::planetary;
}
// Only meshes of planetary gearboxes have keys.
GearboxKind kind_of(MeshKind) {
    return GearboxKind::planetary;
}

// Adds the keys of a description, one for each owner.
template <class Which, std::size_t kCount, std::size_t kRows>
void add_shared(const SharedKey<Which, kCount> (&descriptions)[kRows], std::vector<Key>& keys) {
    for (const auto& one : descriptions) {
        for (const Which which : one.owners) {
            const std::string_view table = table_of(which);
            keys.push_back({"gearbox", fmt::format("{}.{}", table, one.label),
                            one.access[static_cast<std::size_t>(which)], one.unit, one.range,
                            [which, rule = one.presence](const Study& s) {
                                return of_kind(s, kind_of(which), [&](const Study& study) {
                                    return rule(study, which);
                                });
                            },
                            one.fixed_because, fmt::format(fmt::runtime(one.doc), table)});
        }
    }
}

// clang-format off
// Random inputs are drawn in the order of these tables.
const Key kGeneralKeys[] = {
    {"gearbox", "kind", choice<&G::kind>(kKinds), kNone, kAny, always, kShared, "kind of gearbox"},
    {"gearbox", "planets", integer<&G::planets>, kNone, closed_range(2, 8), planetary<always>, kGeometry, "number of planets"},
    {"gearbox", "planet_positions_deg", ascending<&G::planet_positions_rad>, kDeg, Range{0.0, 360.0, false, true}, planetary<may>, kGeometry, "angles of the planets on the carrier, starting with 0, positive in the sense in which the sun's torque turns; by default equally spaced, or as nearly as the teeth allow"},
    {"gearbox", "centre_distance_mm", number<&G::centre_distance_m>, kMm, kPositive, shifted_teeth, kGeometry, "working centre distance of sun and planets, or of pinion and gear"},
    {"gearbox", "module_mm", number<&G::module_m>, kMm, kPositive, tooth_module, kGeometry, "module; in the transverse plane if the teeth are helical"},
    {"gearbox", "normal_module_mm", number<&G::normal_module_m>, kMm, kPositive, may, kGeometry, "module of helical teeth in the normal plane, as on drawings; instead of gearbox.module_mm"},
    {"gearbox", "pressure_angle_deg", number<&G::pressure_angle_rad>, kDeg, inside(0, 45), always, kGeometry, "pressure angle; in the normal plane if the teeth are helical"},
    {"gearbox", "helix_angle_deg", number<&G::helix_angle_rad>, kDeg, Range{0.0, 45.0, false, true}, may, kGeometry, "helix angle on the reference circle"},
    {"gearbox", "face_width_mm", number<&G::face_width_m>, kMm, kPositive, tooth_body, kGeometry, "face width of all gears"},
    {"gearbox", "young_modulus_Pa", number<&G::young_modulus_Pa>, kPa, kPositive, tooth_body, kGeometry, "Young's modulus"},
    {"gearbox", "poisson_ratio", number<&G::poisson_ratio>, kNone, Range{0.0, 0.5, false, true}, tooth_body, kGeometry, "Poisson's ratio"},
    {"gearbox", "addendum_coefficient", number<&G::addendum_coefficient>, kNone, kPositive, may, kGeometry, "addendum divided by the module"},
    {"gearbox", "dedendum_coefficient", number<&G::dedendum_coefficient>, kNone, kPositive, may, kGeometry, "dedendum divided by the module"},
    {"gearbox", "tooth_profile", choice<&G::tooth_profile>(kProfiles), kNone, kAny, may, kShared, "where the beam model of a tooth starts; \"constant\" and \"square-wave\": the mesh stiffness of a planetary gearbox is given instead"},
    {"gearbox", "ring_to_sun_phase", number<&G::ring_to_sun_phase>, kNone, inside(-1, 1), planetary<may>, kShared, "mesh periods by which a planet's ring mesh lags its sun mesh; by default from the geometry"},
};
const MemberKey kBodyKeys[] = {
    {"teeth", kGears, of_members<&B::teeth>(), kNone, closed_range(3, 10000), each<tooth_numbers>, kGeometry, "teeth of the {}"},
    {"shift", kGears, of_members<&B::profile_shift>(), kNone, inside(-2, 2), each<shifted_teeth>, kGeometry, "profile shift of the {} divided by the module; positive makes teeth thicker and the tip circle of a ring smaller (ISO 21771; other conventions use the opposite sign for rings). Shifts and centre distance that are not given follow from zero backlash"},
    {"tip_mm", kGears, of_members<&B::tip_diameter_m>(), kMm, kPositive, each<shifted_teeth>, kGeometry, "tip diameter of the {}; by default from addendum and shift, shortened as far as tip clearance needs"},
    {"tip_relief_um", kGears, of_members<&B::tip_relief_m>(), kUm, kNotNegative, each<tooth_model>, kGeometry, "tip relief of the flanks of the {}, along the line of action; the transmission error of relief is computed for the nominal load"},
    {"tip_relief_length_mm", kGears, of_members<&B::tip_relief_length_m>(), kMm, kPositive, tip_relief_length, kGeometry, "length of the tip relief of the {} along the line of action, from the end of contact"},
    {"crowning_um", kCrowned, of_members<&B::crowning_m>(), kUm, kNotNegative, each<tooth_model>, kGeometry, "crowning of the flanks of the {}: depth removed at both ends of the face, by a parabola along the face width"},
    {"bore_mm", kBored, of_members<&B::held_diameter_m>(), kMm, kPositive, each<foundation>, kGeometry, "diameter of the bore of the {}"},
    {"outer_mm", kRing, of_members<&B::held_diameter_m>(), kMm, kPositive, each<ring_foundation>, kGeometry, "outer diameter of the {}"},
    {"rim_mm", kPlanet, of_members<&B::rim_m>(), kMm, kPositive, rim, kGeometry, "thickness of the rim of the {} below the tooth roots, if a thinner web carries it"},
    {"web_mm", kPlanet, of_members<&B::web_m>(), kMm, kPositive, web, kGeometry, "thickness of the web of the {} under the rim, in the middle of the face width; rim and web reduce the stiffness of the meshes by the gear blank factor of ISO 6336-1"},
    {"mass_kg", kAllMembers, of_members<&B::mass_kg>(), kKg, kPositive, each<mass>, kRandom, "mass of the {}"},
    {"inertia_kg_m2", kAllMembers, of_members<&B::inertia_kg_m2>(), kKgM2, kPositive, each<inertia>, kRandom, "moment of inertia J of the {}; that of a solid disc by default"},
    {"inertia_over_r2_kg", kPlanetary, of_members<&B::inertia_over_r2_kg>(), kKg, kPositive, each<inertia_over_r2>, kRandom, "moment of inertia J of the {} divided by the square of the base radius, or for the carrier of the centre distance"},
};
const Key kMachineKeys[] = {
    {"gearbox", "motor_inertia_kg_m2", number<&F::motor_inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<mass>, kRandom, "moment of inertia of the motor"},
    {"gearbox", "load_inertia_kg_m2", number<&F::load_inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<mass>, kRandom, "moment of inertia of the load"},
};
const MemberKey kBearingKeys[] = {
    {"bearing_stiffness_N_m", kPlanetary, of_members<&B::bearing_stiffness_N_m>(), kNPerM, kNotNegative, each<bearing>, kRandom, "radial bearing stiffness of the {}"},
    {"bearing_stiffness_N_m", kPairGears, of_members<&B::bearing_stiffness_N_m>(), kNPerM, kPositive, each<bearing>, kRandom, "radial bearing stiffness of the {}"},
    {"bearing_damping_N_s_m", kAllMembers, of_members<&B::bearing_damping_N_s_m>(), kNSPerM, kNotNegative, each<may>, kRandom, "radial bearing damping of the {}"},
};
const Key kSupportKeys[] = {
    {"gearbox", "support_stiffness_N_m", number<&G::support_stiffness_N_m>, kNPerM, kPositive, planetary<always>, kRandom, "tangential stiffness that holds the fixed member"},
    {"gearbox", "support_damping_N_s_m", number<&G::support_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "tangential damping of the fixed member"},
    {"gearbox", "motor_coupling_stiffness_N_m_rad", number<&F::motor_coupling_stiffness_N_m_rad>, kNmPerRad, kPositive, fixed_shaft<always>, kRandom, "torsional stiffness of the coupling between motor and pinion"},
    {"gearbox", "motor_coupling_damping_N_m_s_rad", number<&F::motor_coupling_damping_N_m_s_rad>, kNmSPerRad, kNotNegative, fixed_shaft<may>, kRandom, "torsional damping of the coupling between motor and pinion"},
    {"gearbox", "load_coupling_stiffness_N_m_rad", number<&F::load_coupling_stiffness_N_m_rad>, kNmPerRad, kPositive, fixed_shaft<always>, kRandom, "torsional stiffness of the coupling between gear and load"},
    {"gearbox", "load_coupling_damping_N_m_s_rad", number<&F::load_coupling_damping_N_m_s_rad>, kNmSPerRad, kNotNegative, fixed_shaft<may>, kRandom, "torsional damping of the coupling between gear and load"},
};
// Keys that follow those of mesh damping.
const MeshKey kMeshKeys[] = {
    {"stiffness_N_m", kPlanetMeshes, of_meshes<&M::stiffness_N_m>(), kNPerM, kPositive, mesh<constant_stiffness>, kShared, "constant stiffness of these meshes"},
    {"low_stiffness_N_m", kPlanetMeshes, of_meshes<&M::low_stiffness_N_m>(), kNPerM, kPositive, mesh<needed_for<"gearbox.tooth_profile", "square-wave">>, kShared, "stiffness of these meshes with the smaller number of tooth pairs in contact"},
    {"high_stiffness_N_m", kPlanetMeshes, of_meshes<&M::high_stiffness_N_m>(), kNPerM, kPositive, mesh<needed_for<"gearbox.tooth_profile", "square-wave">>, kShared, "stiffness of these meshes with the larger number of tooth pairs in contact"},
    {"contact_ratio", kPlanetMeshes, of_meshes<&M::contact_ratio>(), kNone, closed_range(1, 2), mesh<needed_for<"gearbox.tooth_profile", "square-wave">>, kShared, "contact ratio of these meshes: mesh periods for which a tooth pair is in contact"},
    {"error_um", kPlanetMeshes, of_meshes<&M::error_m>(), kUm, kNotNegative, mesh<may>, kShared, "static transmission error of these meshes: amplitudes of mesh harmonics 1, 2, ..."},
    {"error_phase_deg", kRingMesh, of_meshes<&M::error_phase_rad>(), kDeg, kAny, mesh<may>, kShared, "phases of error_um, those of the sun meshes being 0; 0 by default"},
};
const Key kQualityKeys[] = {
    {"gearbox", "backlash_mm", number<&G::backlash_m>, kMm, kPositive, needed_for<"effects.separation", "two-sided">, kRandom, "backlash 2b along the line of action"},
    {"gearbox", "tooth_quality", number<&E::tooth_quality>, kNone, kGrade, tooth_quality, kRandom, "ISO 1328 grade of all gears; 90 % of the random gears keep each of its tolerances: pitch, cumulative pitch, runout and profile"},
};
const MemberKey kToothKeys[] = {
    {"quality", kGraded, of_members<&B::quality>(), kNone, kGrade, each<tooth_quality>, kRandom, "ISO 1328 grade of the {}, instead of tooth_quality"},
    {"index_um", kGears, of_members<&B::index_m>(), kUm, kAny, each<may>, kShared, "measured index deviations of the teeth of the {}, instead of random ones, along the line of action, gaps positive, starting with the tooth that meets its first mate first. For planets those of the flanks that meet the sun, one planet after the other"},
    {"ring_side_index_um", kPlanet, of_members<&B::ring_side_index_m>(), kUm, kAny, each<may>, kShared, "measured index deviations of the flanks of the same teeth that meet the ring"},
};
const Key kErrorKeys[] = {
    {"gearbox", "pitch_error_um", number<&E::pitch_error_m>, kUm, kNotNegative, may, kRandom, "rms of random pitch errors, independent for each flank and gearbox; in addition to those of a quality"},
    {"gearbox", "eccentricity_um", number<&E::eccentricity_m>, kUm, kNotNegative, may, kRandom, "rms distance of a gear's toothing from its axis; in addition to that of a quality"},
    {"gearbox", "pin_tangential_um", numbers<&P::pin_tangential_m>, kUm, kAny, planetary<bearings_move>, kShared, "tangential position error of each planet's pin in the carrier, in the carrier's sense of rotation"},
    {"gearbox", "pin_radial_um", numbers<&P::pin_radial_m>, kUm, kAny, planetary<bearings_move>, kShared, "radial position error of each planet's pin in the carrier, away from the axis"},
    {"gearbox", "pin_tangential_rms_um", number<&P::pin_tangential_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of random tangential pin errors, independent for each planet and gearbox"},
    {"gearbox", "pin_radial_rms_um", number<&P::pin_radial_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of random radial pin errors, independent for each planet and gearbox"},
};
// clang-format on

template <MeshDamping kLaw>
Key damping_key(const dynamics::DampingParameter& parameter, std::string_view law) {
    const auto presence = [why = "belongs to effects.mesh_damping = \"" + std::string(law) +
                                 "\""](const Study& s) -> Presence {
        if (s.effects.quasi_static()) {
            return {Need::optional, "", {}};
        }
        return {s.effects.mesh_damping == kLaw ? Need::required : Need::forbidden,
                why,
                {"effects.mesh_damping", "effects.motion"}};
    };
    return {"gearbox",    std::string(parameter.key),
            number<kLaw>, {parameter.suffix, parameter.unit, parameter.suffix, parameter.unit, 1.0},
            kNotNegative, presence,
            kRandom,      std::string(parameter.doc)};
}

}  // namespace

std::span<const Key> gearbox_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
        const auto add = [&](std::span<const Key> table) {
            all.insert(all.end(), table.begin(), table.end());
        };
        add(kGeneralKeys);
        add_shared(kBodyKeys, all);
        add(kMachineKeys);
        add_shared(kBearingKeys, all);
        add(kSupportKeys);
#define GEARPOD_MESH_DAMPING(NAME, LAW) \
    all.push_back(damping_key<MeshDamping::NAME>(dynamics::LAW::kParameter, #NAME));
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
        add_shared(kMeshKeys, all);
        add(kQualityKeys);
        add_shared(kToothKeys, all);
        add(kErrorKeys);
        return all;
    }();
    return keys;
}

}  // namespace gearpod::mc
