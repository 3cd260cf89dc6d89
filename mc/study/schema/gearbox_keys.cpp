// Keys of [gearbox].
#include <string>
#include <utility>
#include <vector>

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

constexpr ChoiceName kReliefShapes[] = {name("linear", gears::ReliefShape::linear),
                                        name("parabolic", gears::ReliefShape::parabolic)};

using G = Gearbox;
using F = FixedShaft;
using E = MeshErrors;
using P = PlanetDifferences;
using B = MemberValues;
using M = MeshValues;

// clang-format off
const Key kGearboxKeys[] = {
    {"gearbox", "kind", choice<&G::kind>(kKinds), kNone, kAny, always, kShared, "kind of gearbox"},
    {"gearbox", "planets", integer<&G::planets>, kNone, closed_range(2, 8), planetary<always>, kGeometry, "number of planets"},
    {"gearbox", "planet_positions_deg", ascending<&G::planet_positions_rad>, kDeg, Range{0.0, 360.0, false, true}, planetary<may>, kGeometry, "angles of the planets on the carrier, starting with 0, positive in the sense in which the sun's torque turns; by default equally spaced, or as nearly as the teeth allow"},
    {"gearbox", "sun_teeth", integer<Member::sun, &B::teeth>, kNone, closed_range(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of the sun"},
    {"gearbox", "planet_teeth", integer<Member::planet, &B::teeth>, kNone, closed_range(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of a planet"},
    {"gearbox", "ring_teeth", integer<Member::ring, &B::teeth>, kNone, closed_range(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of the ring"},
    {"gearbox", "pinion_teeth", integer<Member::pinion, &B::teeth>, kNone, closed_range(3, 10000), fixed_shaft<always>, kGeometry, "teeth of the pinion, which drives the gear"},
    {"gearbox", "gear_teeth", integer<Member::gear, &B::teeth>, kNone, closed_range(3, 10000), fixed_shaft<always>, kGeometry, "teeth of the gear"},
    {"gearbox", "sun_shift", number<Member::sun, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "profile shift of the sun divided by the module; positive makes teeth thicker. Shifts and centre distance that are not given follow from zero backlash"},
    {"gearbox", "planet_shift", number<Member::planet, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "profile shift of the planets divided by the module"},
    {"gearbox", "ring_shift", number<Member::ring, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "profile shift of the ring divided by the module; positive makes its tip circle smaller (ISO 21771; other conventions use the opposite sign)"},
    {"gearbox", "pinion_shift", number<Member::pinion, &B::profile_shift>, kNone, inside(-2, 2), fixed_shaft<shifted_teeth>, kGeometry, "profile shift of the pinion divided by the module"},
    {"gearbox", "gear_shift", number<Member::gear, &B::profile_shift>, kNone, inside(-2, 2), fixed_shaft<shifted_teeth>, kGeometry, "profile shift of the gear divided by the module"},
    {"gearbox", "centre_distance_mm", number<&G::centre_distance_m>, kMm, kPositive, shifted_teeth, kGeometry, "working centre distance of sun and planets, or of pinion and gear"},
    {"gearbox", "sun_tip_mm", number<Member::sun, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "tip diameter of the sun; by default from addendum and shift, shortened as far as tip clearance needs"},
    {"gearbox", "planet_tip_mm", number<Member::planet, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "tip diameter of a planet"},
    {"gearbox", "ring_tip_mm", number<Member::ring, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "tip diameter of the ring"},
    {"gearbox", "pinion_tip_mm", number<Member::pinion, &B::tip_diameter_m>, kMm, kPositive, fixed_shaft<shifted_teeth>, kGeometry, "tip diameter of the pinion"},
    {"gearbox", "gear_tip_mm", number<Member::gear, &B::tip_diameter_m>, kMm, kPositive, fixed_shaft<shifted_teeth>, kGeometry, "tip diameter of the gear"},
    {"gearbox", "sun_tip_relief_um", number<Member::sun, &B::tip_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "tip relief of the sun's flanks, along the line of action; the transmission error of relief is computed for the nominal load"},
    {"gearbox", "sun_tip_relief_length_mm", number<Member::sun, &B::tip_relief_length_m>, kMm, kPositive, planetary<tip_relief_length<Member::sun>>, kGeometry, "length of the sun's tip relief along the line of action, from the end of contact"},
    {"gearbox", "sun_root_relief_um", number<Member::sun, &B::root_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "root relief of the sun's flanks, at the end of contact near the root, along the line of action"},
    {"gearbox", "sun_root_relief_length_mm", number<Member::sun, &B::root_relief_length_m>, kMm, kPositive, planetary<root_relief_length<Member::sun>>, kGeometry, "length of the sun's root relief along the line of action, from the end of contact"},
    {"gearbox", "sun_crowning_um", number<Member::sun, &B::crowning_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "crowning of the sun's flanks: depth removed at both ends of the face, by a parabola along the face width"},
    {"gearbox", "planet_tip_relief_um", number<Member::planet, &B::tip_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "tip relief of the planets' flanks, along the line of action"},
    {"gearbox", "planet_tip_relief_length_mm", number<Member::planet, &B::tip_relief_length_m>, kMm, kPositive, planetary<tip_relief_length<Member::planet>>, kGeometry, "length of the planets' tip relief along the line of action, from the end of contact"},
    {"gearbox", "planet_root_relief_um", number<Member::planet, &B::root_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "root relief of the planets' flanks, at the end of contact near the root, along the line of action"},
    {"gearbox", "planet_root_relief_length_mm", number<Member::planet, &B::root_relief_length_m>, kMm, kPositive, planetary<root_relief_length<Member::planet>>, kGeometry, "length of the planets' root relief along the line of action, from the end of contact"},
    {"gearbox", "planet_crowning_um", number<Member::planet, &B::crowning_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "crowning of the planets' flanks: depth removed at both ends of the face, by a parabola along the face width"},
    {"gearbox", "ring_tip_relief_um", number<Member::ring, &B::tip_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "tip relief of the ring's flanks, along the line of action"},
    {"gearbox", "ring_tip_relief_length_mm", number<Member::ring, &B::tip_relief_length_m>, kMm, kPositive, planetary<tip_relief_length<Member::ring>>, kGeometry, "length of the ring's tip relief along the line of action, from the end of contact"},
    {"gearbox", "ring_root_relief_um", number<Member::ring, &B::root_relief_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "root relief of the ring's flanks, at the end of contact near the root, along the line of action"},
    {"gearbox", "ring_root_relief_length_mm", number<Member::ring, &B::root_relief_length_m>, kMm, kPositive, planetary<root_relief_length<Member::ring>>, kGeometry, "length of the ring's root relief along the line of action, from the end of contact"},
    {"gearbox", "ring_crowning_um", number<Member::ring, &B::crowning_m>, kUm, kNotNegative, planetary<tooth_model>, kGeometry, "crowning of the ring's flanks: depth removed at both ends of the face, by a parabola along the face width"},
    {"gearbox", "pinion_tip_relief_um", number<Member::pinion, &B::tip_relief_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "tip relief of the pinion's flanks, along the line of action"},
    {"gearbox", "pinion_tip_relief_length_mm", number<Member::pinion, &B::tip_relief_length_m>, kMm, kPositive, fixed_shaft<tip_relief_length<Member::pinion>>, kGeometry, "length of the pinion's tip relief along the line of action, from the end of contact"},
    {"gearbox", "pinion_root_relief_um", number<Member::pinion, &B::root_relief_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "root relief of the pinion's flanks, at the end of contact near the root, along the line of action"},
    {"gearbox", "pinion_root_relief_length_mm", number<Member::pinion, &B::root_relief_length_m>, kMm, kPositive, fixed_shaft<root_relief_length<Member::pinion>>, kGeometry, "length of the pinion's root relief along the line of action, from the end of contact"},
    {"gearbox", "pinion_crowning_um", number<Member::pinion, &B::crowning_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "crowning of the pinion's flanks: depth removed at both ends of the face, by a parabola along the face width"},
    {"gearbox", "gear_tip_relief_um", number<Member::gear, &B::tip_relief_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "tip relief of the gear's flanks, along the line of action"},
    {"gearbox", "gear_tip_relief_length_mm", number<Member::gear, &B::tip_relief_length_m>, kMm, kPositive, fixed_shaft<tip_relief_length<Member::gear>>, kGeometry, "length of the gear's tip relief along the line of action, from the end of contact"},
    {"gearbox", "gear_root_relief_um", number<Member::gear, &B::root_relief_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "root relief of the gear's flanks, at the end of contact near the root, along the line of action"},
    {"gearbox", "gear_root_relief_length_mm", number<Member::gear, &B::root_relief_length_m>, kMm, kPositive, fixed_shaft<root_relief_length<Member::gear>>, kGeometry, "length of the gear's root relief along the line of action, from the end of contact"},
    {"gearbox", "gear_crowning_um", number<Member::gear, &B::crowning_m>, kUm, kNotNegative, fixed_shaft<tooth_model>, kGeometry, "crowning of the gear's flanks: depth removed at both ends of the face, by a parabola along the face width"},
    {"gearbox", "relief_shape", choice<&G::relief_shape>(kReliefShapes), kNone, kAny, relief_shape, kGeometry, "shape of the relief towards the end of contact: \"linear\" or \"parabolic\""},
    {"gearbox", "module_mm", number<&G::module_m>, kMm, kPositive, tooth_module, kGeometry, "module; in the transverse plane if the teeth are helical"},
    {"gearbox", "normal_module_mm", number<&G::normal_module_m>, kMm, kPositive, may, kGeometry, "module of helical teeth in the normal plane, as on drawings; instead of gearbox.module_mm"},
    {"gearbox", "pressure_angle_deg", number<&G::pressure_angle_rad>, kDeg, inside(0, 45), always, kGeometry, "pressure angle; in the normal plane if the teeth are helical"},
    {"gearbox", "helix_angle_deg", number<&G::helix_angle_rad>, kDeg, Range{0.0, 45.0, false, true}, may, kGeometry, "helix angle on the reference circle"},
    {"gearbox", "face_width_mm", number<&G::face_width_m>, kMm, kPositive, tooth_body, kGeometry, "face width of all gears"},
    {"gearbox", "young_modulus_Pa", number<&G::young_modulus_Pa>, kPa, kPositive, tooth_body, kGeometry, "Young's modulus"},
    {"gearbox", "poisson_ratio", number<&G::poisson_ratio>, kNone, Range{0.0, 0.5, false, true}, tooth_body, kGeometry, "Poisson's ratio"},
    {"gearbox", "addendum_coefficient", number<&G::addendum_coefficient>, kNone, kPositive, may, kGeometry, "addendum divided by the module"},
    {"gearbox", "dedendum_coefficient", number<&G::dedendum_coefficient>, kNone, kPositive, may, kGeometry, "dedendum divided by the module"},
    {"gearbox", "tooth_profile", choice<&G::tooth_profile>(kProfiles), kNone, kAny, may, kShared, "where the beam model of a tooth starts; \"constant\" and \"square-wave\": the mesh stiffness is given instead"},
    {"gearbox", "ring_to_sun_phase", number<&G::ring_to_sun_phase>, kNone, inside(-1, 1), planetary<may>, kShared, "mesh periods by which a planet's ring mesh lags its sun mesh; by default from the geometry"},
    {"gearbox", "sun_planet_stiffness_N_m", number<MeshKind::sun_planet, &M::stiffness_N_m>, kNPerM, kPositive, planetary<constant_stiffness>, kShared, "constant sun-planet mesh stiffness"},
    {"gearbox", "ring_planet_stiffness_N_m", number<MeshKind::ring_planet, &M::stiffness_N_m>, kNPerM, kPositive, planetary<constant_stiffness>, kShared, "constant ring-planet mesh stiffness"},
    {"gearbox", "sun_planet_low_stiffness_N_m", number<MeshKind::sun_planet, &M::low_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "sun-planet mesh stiffness with the smaller number of tooth pairs in contact"},
    {"gearbox", "sun_planet_high_stiffness_N_m", number<MeshKind::sun_planet, &M::high_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "sun-planet mesh stiffness with the larger number of tooth pairs in contact"},
    {"gearbox", "sun_planet_contact_ratio", number<MeshKind::sun_planet, &M::contact_ratio>, kNone, closed_range(1, 2), planetary<square_wave>, kShared, "contact ratio of the sun-planet meshes: mesh periods for which a tooth pair is in contact"},
    {"gearbox", "ring_planet_low_stiffness_N_m", number<MeshKind::ring_planet, &M::low_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "ring-planet mesh stiffness with the smaller number of tooth pairs in contact"},
    {"gearbox", "ring_planet_high_stiffness_N_m", number<MeshKind::ring_planet, &M::high_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "ring-planet mesh stiffness with the larger number of tooth pairs in contact"},
    {"gearbox", "ring_planet_contact_ratio", number<MeshKind::ring_planet, &M::contact_ratio>, kNone, closed_range(1, 2), planetary<square_wave>, kShared, "contact ratio of the ring-planet meshes: mesh periods for which a tooth pair is in contact"},
    {"gearbox", "mesh_stiffness_N_m", number<MeshKind::pinion_gear, &M::stiffness_N_m>, kNPerM, kPositive, fixed_shaft<constant_stiffness>, kShared, "constant mesh stiffness"},
    {"gearbox", "mesh_low_stiffness_N_m", number<MeshKind::pinion_gear, &M::low_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<square_wave>, kShared, "mesh stiffness with the smaller number of tooth pairs in contact"},
    {"gearbox", "mesh_high_stiffness_N_m", number<MeshKind::pinion_gear, &M::high_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<square_wave>, kShared, "mesh stiffness with the larger number of tooth pairs in contact"},
    {"gearbox", "mesh_contact_ratio", number<MeshKind::pinion_gear, &M::contact_ratio>, kNone, closed_range(1, 2), fixed_shaft<square_wave>, kShared, "contact ratio of the mesh: mesh periods for which a tooth pair is in contact"},
    {"gearbox", "sun_bore_mm", number<Member::sun, &B::held_diameter_m>, kMm, kPositive, planetary<foundation>, kGeometry, "diameter of the sun's bore"},
    {"gearbox", "planet_bore_mm", number<Member::planet, &B::held_diameter_m>, kMm, kPositive, planetary<foundation>, kGeometry, "diameter of a planet's bore"},
    {"gearbox", "ring_outer_mm", number<Member::ring, &B::held_diameter_m>, kMm, kPositive, planetary<ring_foundation>, kGeometry, "outer diameter of the ring"},
    {"gearbox", "pinion_bore_mm", number<Member::pinion, &B::held_diameter_m>, kMm, kPositive, fixed_shaft<foundation>, kGeometry, "diameter of the pinion's bore"},
    {"gearbox", "gear_bore_mm", number<Member::gear, &B::held_diameter_m>, kMm, kPositive, fixed_shaft<foundation>, kGeometry, "diameter of the gear's bore"},
    {"gearbox", "sun_rim_mm", number<Member::sun, &B::rim_m>, kMm, kPositive, planetary<blank<Member::sun, BlankPart::rim>>, kGeometry, "thickness of the sun's rim below the tooth roots, if a thinner web carries it"},
    {"gearbox", "sun_web_mm", number<Member::sun, &B::web_m>, kMm, kPositive, planetary<blank<Member::sun, BlankPart::web>>, kGeometry, "thickness of the sun's web under the rim, in the middle of the face width; rim and web reduce the stiffness of the sun's meshes by the gear blank factor of ISO 6336-1"},
    {"gearbox", "planet_rim_mm", number<Member::planet, &B::rim_m>, kMm, kPositive, planetary<blank<Member::planet, BlankPart::rim>>, kGeometry, "thickness of a planet's rim below the tooth roots, if a thinner web carries it"},
    {"gearbox", "planet_web_mm", number<Member::planet, &B::web_m>, kMm, kPositive, planetary<blank<Member::planet, BlankPart::web>>, kGeometry, "thickness of a planet's web under the rim"},
    {"gearbox", "pinion_rim_mm", number<Member::pinion, &B::rim_m>, kMm, kPositive, fixed_shaft<blank<Member::pinion, BlankPart::rim>>, kGeometry, "thickness of the pinion's rim below the tooth roots, if a thinner web carries it"},
    {"gearbox", "pinion_web_mm", number<Member::pinion, &B::web_m>, kMm, kPositive, fixed_shaft<blank<Member::pinion, BlankPart::web>>, kGeometry, "thickness of the pinion's web under the rim"},
    {"gearbox", "gear_rim_mm", number<Member::gear, &B::rim_m>, kMm, kPositive, fixed_shaft<blank<Member::gear, BlankPart::rim>>, kGeometry, "thickness of the gear's rim below the tooth roots, if a thinner web carries it"},
    {"gearbox", "gear_web_mm", number<Member::gear, &B::web_m>, kMm, kPositive, fixed_shaft<blank<Member::gear, BlankPart::web>>, kGeometry, "thickness of the gear's web under the rim"},
    {"gearbox", "sun_mass_kg", number<Member::sun, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the sun"},
    {"gearbox", "planet_mass_kg", number<Member::planet, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of a planet"},
    {"gearbox", "ring_mass_kg", number<Member::ring, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the ring"},
    {"gearbox", "carrier_mass_kg", number<Member::carrier, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the carrier"},
    {"gearbox", "sun_inertia_kg_m2", number<Member::sun, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the sun; a solid disc by default"},
    {"gearbox", "planet_inertia_kg_m2", number<Member::planet, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of a planet"},
    {"gearbox", "ring_inertia_kg_m2", number<Member::ring, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the ring"},
    {"gearbox", "carrier_inertia_kg_m2", number<Member::carrier, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the carrier"},
    {"gearbox", "sun_inertia_over_r2_kg", number<Member::sun, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "moment of inertia J divided by the square of the base radius, sun"},
    {"gearbox", "planet_inertia_over_r2_kg", number<Member::planet, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "moment of inertia J divided by the square of the base radius, planet"},
    {"gearbox", "ring_inertia_over_r2_kg", number<Member::ring, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "moment of inertia J divided by the square of the base radius, ring"},
    {"gearbox", "carrier_inertia_over_r2_kg", number<Member::carrier, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "moment of inertia J divided by the square of the centre distance, carrier"},
    {"gearbox", "sun_bearing_stiffness_N_m", number<Member::sun, &B::bearing_stiffness_N_m>, kNPerM, kNotNegative, planetary<bearing>, kRandom, "radial bearing stiffness of the sun"},
    {"gearbox", "planet_bearing_stiffness_N_m", number<Member::planet, &B::bearing_stiffness_N_m>, kNPerM, kNotNegative, planetary<bearing>, kRandom, "radial bearing stiffness of a planet"},
    {"gearbox", "ring_bearing_stiffness_N_m", number<Member::ring, &B::bearing_stiffness_N_m>, kNPerM, kNotNegative, planetary<bearing>, kRandom, "radial bearing stiffness of the ring"},
    {"gearbox", "carrier_bearing_stiffness_N_m", number<Member::carrier, &B::bearing_stiffness_N_m>, kNPerM, kNotNegative, planetary<bearing>, kRandom, "radial bearing stiffness of the carrier"},
    {"gearbox", "sun_bearing_damping_N_s_m", number<Member::sun, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "radial bearing damping of the sun"},
    {"gearbox", "planet_bearing_damping_N_s_m", number<Member::planet, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "radial bearing damping of a planet"},
    {"gearbox", "ring_bearing_damping_N_s_m", number<Member::ring, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "radial bearing damping of the ring"},
    {"gearbox", "carrier_bearing_damping_N_s_m", number<Member::carrier, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "radial bearing damping of the carrier"},
    {"gearbox", "support_stiffness_N_m", number<&G::support_stiffness_N_m>, kNPerM, kPositive, planetary<always>, kRandom, "tangential stiffness that holds the fixed member"},
    {"gearbox", "support_damping_N_s_m", number<&G::support_damping_N_s_m>, kNSPerM, kNotNegative, planetary<may>, kRandom, "tangential damping of the fixed member"},
    {"gearbox", "pinion_mass_kg", number<Member::pinion, &B::mass_kg>, kKg, kPositive, fixed_shaft<mass>, kRandom, "mass of the pinion"},
    {"gearbox", "gear_mass_kg", number<Member::gear, &B::mass_kg>, kKg, kPositive, fixed_shaft<mass>, kRandom, "mass of the gear"},
    {"gearbox", "pinion_inertia_kg_m2", number<Member::pinion, &B::inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<may>, kRandom, "moment of inertia of the pinion; a solid disc by default"},
    {"gearbox", "gear_inertia_kg_m2", number<Member::gear, &B::inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<may>, kRandom, "moment of inertia of the gear; a solid disc by default"},
    {"gearbox", "motor_inertia_kg_m2", number<&F::motor_inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<mass>, kRandom, "moment of inertia of the motor"},
    {"gearbox", "load_inertia_kg_m2", number<&F::load_inertia_kg_m2>, kKgM2, kPositive, fixed_shaft<mass>, kRandom, "moment of inertia of the load"},
    {"gearbox", "pinion_bearing_stiffness_N_m", number<Member::pinion, &B::bearing_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<bearing>, kRandom, "radial bearing stiffness of the pinion"},
    {"gearbox", "gear_bearing_stiffness_N_m", number<Member::gear, &B::bearing_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<bearing>, kRandom, "radial bearing stiffness of the gear"},
    {"gearbox", "pinion_bearing_damping_N_s_m", number<Member::pinion, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, fixed_shaft<may>, kRandom, "radial bearing damping of the pinion"},
    {"gearbox", "gear_bearing_damping_N_s_m", number<Member::gear, &B::bearing_damping_N_s_m>, kNSPerM, kNotNegative, fixed_shaft<may>, kRandom, "radial bearing damping of the gear"},
    {"gearbox", "motor_coupling_stiffness_N_m_rad", number<&F::motor_coupling_stiffness_N_m_rad>, kNmPerRad, kPositive, fixed_shaft<always>, kRandom, "torsional stiffness of the coupling between motor and pinion"},
    {"gearbox", "motor_coupling_damping_N_m_s_rad", number<&F::motor_coupling_damping_N_m_s_rad>, kNmSPerRad, kNotNegative, fixed_shaft<may>, kRandom, "torsional damping of the coupling between motor and pinion"},
    {"gearbox", "load_coupling_stiffness_N_m_rad", number<&F::load_coupling_stiffness_N_m_rad>, kNmPerRad, kPositive, fixed_shaft<always>, kRandom, "torsional stiffness of the coupling between gear and load"},
    {"gearbox", "load_coupling_damping_N_m_s_rad", number<&F::load_coupling_damping_N_m_s_rad>, kNmSPerRad, kNotNegative, fixed_shaft<may>, kRandom, "torsional damping of the coupling between gear and load"},
};
// Keys that follow those of mesh damping.
const Key kMeshKeys[] = {
    {"gearbox", "backlash_mm", number<&G::backlash_m>, kMm, kPositive, backlash, kRandom, "backlash 2b along the line of action"},
    {"gearbox", "sun_planet_error_um", numbers<&E::sun_planet_m>, kUm, kNotNegative, planetary<may>, kShared, "static transmission error of the sun-planet meshes: amplitudes of mesh harmonics 1, 2, ..."},
    {"gearbox", "sun_planet_error_phase_deg", numbers<&E::sun_planet_phase_rad>, kDeg, kAny, planetary<may>, kShared, "phases of sun_planet_error_um; 0 by default"},
    {"gearbox", "ring_planet_error_um", numbers<&E::ring_planet_m>, kUm, kNotNegative, planetary<may>, kShared, "static transmission error of the ring-planet meshes: amplitudes of mesh harmonics 1, 2, ..."},
    {"gearbox", "ring_planet_error_phase_deg", numbers<&E::ring_planet_phase_rad>, kDeg, kAny, planetary<may>, kShared, "phases of ring_planet_error_um; 0 by default"},
    {"gearbox", "mesh_error_um", numbers<&E::mesh_m>, kUm, kNotNegative, fixed_shaft<may>, kShared, "static transmission error: amplitudes of mesh harmonics 1, 2, ..."},
    {"gearbox", "mesh_error_phase_deg", numbers<&E::mesh_phase_rad>, kDeg, kAny, fixed_shaft<may>, kShared, "phases of mesh_error_um; 0 by default"},
    {"gearbox", "tooth_quality", number<&E::tooth_quality>, kNone, kGrade, tooth_quality, kRandom, "ISO 1328 grade of all gears; 90 % of the random gears keep each of its tolerances: pitch, cumulative pitch, runout and profile"},
    {"gearbox", "sun_quality", number<Member::sun, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "ISO 1328 grade of the sun, instead of tooth_quality"},
    {"gearbox", "planet_quality", number<Member::planet, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "ISO 1328 grade of the planets, instead of tooth_quality"},
    {"gearbox", "ring_quality", number<Member::ring, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "ISO 1328 grade of the ring, instead of tooth_quality"},
    {"gearbox", "pinion_quality", number<Member::pinion, &B::quality>, kNone, kGrade, fixed_shaft<tooth_quality>, kRandom, "ISO 1328 grade of the pinion, instead of tooth_quality"},
    {"gearbox", "gear_quality", number<Member::gear, &B::quality>, kNone, kGrade, fixed_shaft<tooth_quality>, kRandom, "ISO 1328 grade of the gear, instead of tooth_quality"},
    {"gearbox", "pitch_error_um", number<&E::pitch_error_m>, kUm, kNotNegative, may, kRandom, "rms of random pitch errors, independent for each flank and gearbox; in addition to those of a quality"},
    {"gearbox", "index_wave_um", number<&E::index_wave_m>, kUm, kNotNegative, may, kRandom, "rms of the long waves of a gear's index deviations, harmonics 1 to 3 of its turn; in addition to those of a quality"},
    {"gearbox", "eccentricity_um", number<&E::eccentricity_m>, kUm, kNotNegative, may, kRandom, "rms distance of a gear's toothing from its axis; in addition to that of a quality"},
    {"gearbox", "profile_slope_um", number<&E::profile_slope_m>, kUm, kNotNegative, may, kRandom, "rms of random profile slopes of a flank over its engagement; in addition to those of a quality"},
    {"gearbox", "sun_index_um", numbers<Member::sun, &B::index_m>, kUm, kAny, planetary<may>, kShared, "measured index deviations of the sun's teeth, instead of random ones, along the line of action, gaps positive; starting with the tooth that meets planet 1 first"},
    {"gearbox", "planet_index_um", numbers<Member::planet, &B::index_m>, kUm, kAny, planetary<may>, kShared, "measured index deviations of the planets' flanks that meet the sun, one planet after the other; each starting with the tooth that meets the sun first"},
    {"gearbox", "planet_ring_side_index_um", numbers<Member::planet, &B::ring_side_index_m>, kUm, kAny, planetary<may>, kShared, "measured index deviations of the flanks of the same teeth that meet the ring"},
    {"gearbox", "ring_index_um", numbers<Member::ring, &B::index_m>, kUm, kAny, planetary<may>, kShared, "measured index deviations of the ring's teeth, starting with the tooth that meets planet 1 first"},
    {"gearbox", "pinion_index_um", numbers<Member::pinion, &B::index_m>, kUm, kAny, fixed_shaft<may>, kShared, "measured index deviations of the pinion's teeth"},
    {"gearbox", "gear_index_um", numbers<Member::gear, &B::index_m>, kUm, kAny, fixed_shaft<may>, kShared, "measured index deviations of the gear's teeth"},
    {"gearbox", "pin_tangential_um", numbers<&P::pin_tangential_m>, kUm, kAny, planetary<bearings_move>, kShared, "tangential position error of each planet's pin in the carrier, in the carrier's sense of rotation"},
    {"gearbox", "pin_radial_um", numbers<&P::pin_radial_m>, kUm, kAny, planetary<bearings_move>, kShared, "radial position error of each planet's pin in the carrier, away from the axis"},
    {"gearbox", "pin_tangential_rms_um", number<&P::pin_tangential_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of random tangential pin errors, independent for each planet and gearbox"},
    {"gearbox", "pin_radial_rms_um", number<&P::pin_radial_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of random radial pin errors, independent for each planet and gearbox"},
    {"gearbox", "planet_bearing_stiffness_factors", numbers<&P::bearing_stiffness>, kNone, kPositive, planetary<bearings_move>, kShared, "each planet's bearing stiffness divided by planet_bearing_stiffness_N_m"},
    {"gearbox", "planet_bearing_stiffness_scatter", number<&P::bearing_stiffness_scatter>, kNone, kNotNegative, planetary<bearings_move>, kRandom, "standard deviation of the logarithm of the planets' bearing stiffness, random for each planet"},
    {"gearbox", "planet_bearing_damping_factors", numbers<&P::bearing_damping>, kNone, kNotNegative, planetary<bearings_damp>, kShared, "each planet's bearing damping divided by planet_bearing_damping_N_s_m"},
    {"gearbox", "planet_bearing_damping_scatter", number<&P::bearing_damping_scatter>, kNone, kNotNegative, planetary<bearings_damp>, kRandom, "standard deviation of the logarithm of the planets' bearing damping, random for each planet"},
    {"gearbox", "planet_mass_factors", numbers<&P::mass>, kNone, kPositive, planetary<planet_masses>, kShared, "each planet's mass and inertia divided by the nominal ones"},
    {"gearbox", "planet_mass_scatter", number<&P::mass_scatter>, kNone, kNotNegative, planetary<planet_masses>, kRandom, "standard deviation of the logarithm of the planets' masses, random for each planet"},
};
// clang-format on

}  // namespace

std::span<const Key> gearbox_keys() {
    return kGearboxKeys;
}

std::span<const Key> mesh_keys() {
    return kMeshKeys;
}

// Keys of the mesh-damping laws, from their own parameters.

namespace {

template <MeshDamping kLaw, std::size_t kParameter>
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
    return {"gearbox",
            parameter.key,
            number<kLaw, kParameter>,
            {parameter.suffix, parameter.unit, parameter.suffix, parameter.unit, 1.0},
            kNotNegative,
            presence,
            kRandom,
            parameter.doc};
}

template <class Law, MeshDamping kLaw>
void add_keys(std::string_view law, std::vector<Key>& keys) {
    constexpr std::size_t kParameters = std::size(Law::kParameters);
    static_assert(kParameters <= dynamics::kMostDampingParameters);
    [&]<std::size_t... kAll>(std::index_sequence<kAll...>) {
        (keys.push_back(damping_key<kLaw, kAll>(Law::kParameters[kAll], law)), ...);
    }
    (std::make_index_sequence<kParameters>());
}

}  // namespace

std::span<const Key> mesh_damping_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
#define GEARPOD_MESH_DAMPING(NAME, LAW) add_keys<dynamics::LAW, MeshDamping::NAME>(#NAME, all);
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
        return all;
    }();
    return keys;
}

}  // namespace gearpod::mc
