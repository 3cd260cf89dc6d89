// Keys of [gearbox].
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"
#include "mc/study/schema/presence.hpp"
#include "mc/study/schema/table.hpp"

namespace gearpod::mc {
namespace {

constexpr ChoiceName kKinds[] = {name("planetary", GearboxKind::planetary),
                                 name("fixed-shaft", GearboxKind::fixed_shaft)};
constexpr ChoiceName kProfiles[] = {
    name("root-circle", ToothProfile::root_circle), name("base-circle", ToothProfile::base_circle),
    name("fillet", ToothProfile::fillet), name("constant", ToothProfile::constant),
    name("square-wave", ToothProfile::square_wave)};

using G = Gearbox;
using F = FixedShaft;
using E = MeshErrors;
using P = UnlikePlanets;
using B = MemberValues;
using M = MeshValues;

// clang-format off
const Key kKeys[] = {
    {"gearbox", "kind", choice<&G::kind>(kKinds), kNone, kAny, always, kShared, "kind of gearbox"},
    {"gearbox", "planets", integer<&G::planets>, kNone, from_to(2, 8), planetary<always>, kGeometry, "number of planets"},
    {"gearbox", "planet_positions_deg", ascending<&G::planet_positions_rad>, kDeg, Range{0.0, 360.0, false, true}, planetary<may>, kGeometry, "angles of the planets on the carrier, the first 0, in the sense of the turn that the sun's torque gives; by default equally spaced, or as nearly as the teeth allow"},
    {"gearbox", "sun_teeth", integer<Member::sun, &B::teeth>, kNone, from_to(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of the sun"},
    {"gearbox", "planet_teeth", integer<Member::planet, &B::teeth>, kNone, from_to(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of a planet"},
    {"gearbox", "ring_teeth", integer<Member::ring, &B::teeth>, kNone, from_to(3, 10000), planetary<tooth_numbers>, kGeometry, "teeth of the ring"},
    {"gearbox", "pinion_teeth", integer<Member::pinion, &B::teeth>, kNone, from_to(3, 10000), fixed_shaft<always>, kGeometry, "teeth of the pinion, which drives"},
    {"gearbox", "gear_teeth", integer<Member::gear, &B::teeth>, kNone, from_to(3, 10000), fixed_shaft<always>, kGeometry, "teeth of the gear"},
    {"gearbox", "sun_shift", number<Member::sun, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "profile shift of the sun over the module; positive makes teeth thicker, and what is not given of shifts and centre distance follows without backlash"},
    {"gearbox", "planet_shift", number<Member::planet, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "that of the planets"},
    {"gearbox", "ring_shift", number<Member::ring, &B::profile_shift>, kNone, inside(-2, 2), planetary<shifted_teeth>, kGeometry, "that of the ring, whose tip circle it makes smaller (ISO 21771; others count it with the other sign)"},
    {"gearbox", "pinion_shift", number<Member::pinion, &B::profile_shift>, kNone, inside(-2, 2), fixed_shaft<shifted_teeth>, kGeometry, "that of the pinion"},
    {"gearbox", "gear_shift", number<Member::gear, &B::profile_shift>, kNone, inside(-2, 2), fixed_shaft<shifted_teeth>, kGeometry, "that of the gear"},
    {"gearbox", "centre_distance_mm", number<&G::centre_distance_m>, kMm, kPositive, shifted_teeth, kGeometry, "distance at which the axes of sun and planets, or of the pair, work"},
    {"gearbox", "sun_tip_mm", number<Member::sun, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "diameter of the sun's tip circle; by default from addendum and shift, shortened by what keeps tips off roots"},
    {"gearbox", "planet_tip_mm", number<Member::planet, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "that of a planet"},
    {"gearbox", "ring_tip_mm", number<Member::ring, &B::tip_diameter_m>, kMm, kPositive, planetary<shifted_teeth>, kGeometry, "that of the ring"},
    {"gearbox", "pinion_tip_mm", number<Member::pinion, &B::tip_diameter_m>, kMm, kPositive, fixed_shaft<shifted_teeth>, kGeometry, "that of the pinion"},
    {"gearbox", "gear_tip_mm", number<Member::gear, &B::tip_diameter_m>, kMm, kPositive, fixed_shaft<shifted_teeth>, kGeometry, "that of the gear"},
    {"gearbox", "module_mm", number<&G::module_m>, kMm, kPositive, tooth_module, kGeometry, "module; in the transverse plane if the teeth are helical"},
    {"gearbox", "pressure_angle_deg", number<&G::pressure_angle_rad>, kDeg, inside(0, 45), always, kGeometry, "pressure angle; in the normal plane if the teeth are helical"},
    {"gearbox", "helix_angle_deg", number<&G::helix_angle_rad>, kDeg, Range{0.0, 45.0, false, true}, planetary<helix>, kGeometry, "helix angle"},
    {"gearbox", "face_width_mm", number<&G::face_width_m>, kMm, kPositive, tooth_body, kGeometry, "face width of all gears"},
    {"gearbox", "young_modulus_Pa", number<&G::young_modulus_Pa>, kPa, kPositive, tooth_body, kGeometry, "Young's modulus"},
    {"gearbox", "poisson_ratio", number<&G::poisson_ratio>, kNone, Range{0.0, 0.5, false, true}, tooth_body, kGeometry, "Poisson's ratio"},
    {"gearbox", "addendum_coefficient", number<&G::addendum_coefficient>, kNone, kPositive, may, kGeometry, "addendum over module"},
    {"gearbox", "dedendum_coefficient", number<&G::dedendum_coefficient>, kNone, kPositive, may, kGeometry, "dedendum over module"},
    {"gearbox", "tooth_profile", choice<&G::tooth_profile>(kProfiles), kNone, kAny, may, kShared, "where the tooth's beam begins, or given mesh stiffness"},
    {"gearbox", "ring_to_sun_phase", number<&G::ring_to_sun_phase>, kNone, inside(-1, 1), planetary<may>, kShared, "mesh periods by which a planet's ring mesh is later than its sun mesh; from the geometry by default"},
    {"gearbox", "sun_planet_stiffness_N_m", number<MeshKind::sun_planet, &M::stiffness_N_m>, kNPerM, kPositive, planetary<constant_stiffness>, kShared, "constant sun-planet mesh stiffness"},
    {"gearbox", "ring_planet_stiffness_N_m", number<MeshKind::ring_planet, &M::stiffness_N_m>, kNPerM, kPositive, planetary<constant_stiffness>, kShared, "constant ring-planet mesh stiffness"},
    {"gearbox", "sun_planet_low_stiffness_N_m", number<MeshKind::sun_planet, &M::low_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "sun-planet mesh stiffness while fewer tooth pairs touch"},
    {"gearbox", "sun_planet_high_stiffness_N_m", number<MeshKind::sun_planet, &M::high_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "sun-planet mesh stiffness while more tooth pairs touch"},
    {"gearbox", "sun_planet_contact_ratio", number<MeshKind::sun_planet, &M::contact_ratio>, kNone, from_to(1, 2), planetary<square_wave>, kShared, "mesh periods that a sun-planet tooth pair touches"},
    {"gearbox", "ring_planet_low_stiffness_N_m", number<MeshKind::ring_planet, &M::low_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "ring-planet mesh stiffness while fewer tooth pairs touch"},
    {"gearbox", "ring_planet_high_stiffness_N_m", number<MeshKind::ring_planet, &M::high_stiffness_N_m>, kNPerM, kPositive, planetary<square_wave>, kShared, "ring-planet mesh stiffness while more tooth pairs touch"},
    {"gearbox", "ring_planet_contact_ratio", number<MeshKind::ring_planet, &M::contact_ratio>, kNone, from_to(1, 2), planetary<square_wave>, kShared, "mesh periods that a ring-planet tooth pair touches"},
    {"gearbox", "mesh_stiffness_N_m", number<MeshKind::pinion_gear, &M::stiffness_N_m>, kNPerM, kPositive, fixed_shaft<constant_stiffness>, kShared, "constant mesh stiffness"},
    {"gearbox", "mesh_low_stiffness_N_m", number<MeshKind::pinion_gear, &M::low_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<square_wave>, kShared, "mesh stiffness while fewer tooth pairs touch"},
    {"gearbox", "mesh_high_stiffness_N_m", number<MeshKind::pinion_gear, &M::high_stiffness_N_m>, kNPerM, kPositive, fixed_shaft<square_wave>, kShared, "mesh stiffness while more tooth pairs touch"},
    {"gearbox", "mesh_contact_ratio", number<MeshKind::pinion_gear, &M::contact_ratio>, kNone, from_to(1, 2), fixed_shaft<square_wave>, kShared, "mesh periods that a tooth pair touches"},
    {"gearbox", "sun_bore_mm", number<Member::sun, &B::held_diameter_m>, kMm, kPositive, planetary<foundation>, kGeometry, "diameter of the sun's bore"},
    {"gearbox", "planet_bore_mm", number<Member::planet, &B::held_diameter_m>, kMm, kPositive, planetary<foundation>, kGeometry, "diameter of a planet's bore"},
    {"gearbox", "ring_outer_mm", number<Member::ring, &B::held_diameter_m>, kMm, kPositive, planetary<ring_foundation>, kGeometry, "outer diameter of the ring"},
    {"gearbox", "pinion_bore_mm", number<Member::pinion, &B::held_diameter_m>, kMm, kPositive, fixed_shaft<foundation>, kGeometry, "diameter of the pinion's bore"},
    {"gearbox", "gear_bore_mm", number<Member::gear, &B::held_diameter_m>, kMm, kPositive, fixed_shaft<foundation>, kGeometry, "diameter of the gear's bore"},
    {"gearbox", "sun_mass_kg", number<Member::sun, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the sun"},
    {"gearbox", "planet_mass_kg", number<Member::planet, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of a planet"},
    {"gearbox", "ring_mass_kg", number<Member::ring, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the ring"},
    {"gearbox", "carrier_mass_kg", number<Member::carrier, &B::mass_kg>, kKg, kPositive, planetary<mass>, kRandom, "mass of the carrier"},
    {"gearbox", "sun_inertia_kg_m2", number<Member::sun, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the sun; a solid disc by default"},
    {"gearbox", "planet_inertia_kg_m2", number<Member::planet, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of a planet"},
    {"gearbox", "ring_inertia_kg_m2", number<Member::ring, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the ring"},
    {"gearbox", "carrier_inertia_kg_m2", number<Member::carrier, &B::inertia_kg_m2>, kKgM2, kPositive, planetary<inertia>, kRandom, "moment of inertia J of the carrier"},
    {"gearbox", "sun_inertia_over_r2_kg", number<Member::sun, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "J over base radius squared, sun"},
    {"gearbox", "planet_inertia_over_r2_kg", number<Member::planet, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "J over base radius squared, planet"},
    {"gearbox", "ring_inertia_over_r2_kg", number<Member::ring, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "J over base radius squared, ring"},
    {"gearbox", "carrier_inertia_over_r2_kg", number<Member::carrier, &B::inertia_over_r2_kg>, kKg, kPositive, planetary<inertia_over_r2>, kRandom, "J over centre distance squared, carrier"},
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
    {"gearbox", "mesh_damping_ratio", number<&G::mesh_damping_ratio>, kNone, kNotNegative, damping_ratio, kRandom, "zeta of c = 2 zeta sqrt(k m1 m2 / (m1 + m2))"},
    {"gearbox", "mesh_damping_time_s", number<&G::mesh_damping_time_s>, kS, kNotNegative, damping_time, kRandom, "mu of c = mu k"},
    {"gearbox", "mesh_damping_N_s_m", number<&G::mesh_damping_N_s_m>, kNSPerM, kNotNegative, damping_constant, kRandom, "constant mesh damping"},
    {"gearbox", "backlash_mm", number<&G::backlash_m>, kMm, kPositive, backlash, kRandom, "backlash 2b along the line of action"},
    {"gearbox", "sun_planet_error_um", numbers<&E::sun_planet_m>, kUm, kNotNegative, planetary<may>, kShared, "static transmission error of the sun-planet meshes: amplitudes of mesh harmonics 1, 2, ..."},
    {"gearbox", "sun_planet_error_phase_deg", numbers<&E::sun_planet_phase_rad>, kDeg, kAny, planetary<may>, kShared, "their phases; 0 by default"},
    {"gearbox", "ring_planet_error_um", numbers<&E::ring_planet_m>, kUm, kNotNegative, planetary<may>, kShared, "static transmission error of the ring-planet meshes"},
    {"gearbox", "ring_planet_error_phase_deg", numbers<&E::ring_planet_phase_rad>, kDeg, kAny, planetary<may>, kShared, "their phases; 0 by default"},
    {"gearbox", "mesh_error_um", numbers<&E::mesh_m>, kUm, kNotNegative, fixed_shaft<may>, kShared, "static transmission error: amplitudes of mesh harmonics 1, 2, ..."},
    {"gearbox", "mesh_error_phase_deg", numbers<&E::mesh_phase_rad>, kDeg, kAny, fixed_shaft<may>, kShared, "their phases; 0 by default"},
    {"gearbox", "tooth_quality", number<&E::tooth_quality>, kNone, kGrade, tooth_quality, kRandom, "ISO 1328 grade of all gears, of which nine in ten gears drawn keep each tolerance: pitch, cumulative pitch, runout and profile"},
    {"gearbox", "sun_quality", number<Member::sun, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "that of the sun alone"},
    {"gearbox", "planet_quality", number<Member::planet, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "that of the planets"},
    {"gearbox", "ring_quality", number<Member::ring, &B::quality>, kNone, kGrade, planetary<tooth_quality>, kRandom, "that of the ring"},
    {"gearbox", "pinion_quality", number<Member::pinion, &B::quality>, kNone, kGrade, fixed_shaft<tooth_quality>, kRandom, "that of the pinion"},
    {"gearbox", "gear_quality", number<Member::gear, &B::quality>, kNone, kGrade, fixed_shaft<tooth_quality>, kRandom, "that of the gear"},
    {"gearbox", "pitch_error_um", number<&E::pitch_error_m>, kUm, kNotNegative, may, kRandom, "rms of a tooth's own pitch error, drawn for each flank and gearbox, beside a quality's"},
    {"gearbox", "index_wave_um", number<&E::index_wave_m>, kUm, kNotNegative, may, kRandom, "rms of the long waves of a gear's index deviations, harmonics 1 to 3 of its turn, beside a quality's"},
    {"gearbox", "eccentricity_um", number<&E::eccentricity_m>, kUm, kNotNegative, may, kRandom, "rms distance of a gear's toothing from its axis, beside a quality's"},
    {"gearbox", "profile_slope_um", number<&E::profile_slope_m>, kUm, kNotNegative, may, kRandom, "rms of a flank's own profile slope over its engagement, beside a quality's"},
    {"gearbox", "sun_index_um", numbers<Member::sun, &B::index_m>, kUm, kAny, planetary<may>, kShared, "measured index deviations of the sun's teeth in place of drawn ones, along the line of action, a gap positive; from the tooth that meets planet 1 first"},
    {"gearbox", "planet_index_um", numbers<Member::planet, &B::index_m>, kUm, kAny, planetary<may>, kShared, "those of the planets' sides that meet the sun, one planet after the other; each from the tooth that meets the sun first"},
    {"gearbox", "planet_ring_side_index_um", numbers<Member::planet, &B::ring_side_index_m>, kUm, kAny, planetary<may>, kShared, "those of the same teeth's sides that meet the ring"},
    {"gearbox", "ring_index_um", numbers<Member::ring, &B::index_m>, kUm, kAny, planetary<may>, kShared, "those of the ring's teeth, from the tooth that meets planet 1 first"},
    {"gearbox", "pinion_index_um", numbers<Member::pinion, &B::index_m>, kUm, kAny, fixed_shaft<may>, kShared, "those of the pinion's teeth"},
    {"gearbox", "gear_index_um", numbers<Member::gear, &B::index_m>, kUm, kAny, fixed_shaft<may>, kShared, "those of the gear's teeth"},
    {"gearbox", "pin_tangential_um", numbers<&P::pin_tangential_m>, kUm, kAny, planetary<bearings_move>, kShared, "how far each planet's pin is off its place in the carrier, along the carrier's turn"},
    {"gearbox", "pin_radial_um", numbers<&P::pin_radial_m>, kUm, kAny, planetary<bearings_move>, kShared, "how far each planet's pin is off its place, away from the axis"},
    {"gearbox", "pin_tangential_rms_um", number<&P::pin_tangential_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of the pins' tangential errors, drawn for each planet and gearbox"},
    {"gearbox", "pin_radial_rms_um", number<&P::pin_radial_rms_m>, kUm, kNotNegative, planetary<bearings_move>, kRandom, "rms of the pins' radial errors, drawn for each planet and gearbox"},
    {"gearbox", "planet_bearing_stiffness_factors", numbers<&P::bearing_stiffness>, kNone, kPositive, planetary<bearings_move>, kShared, "each planet's bearing stiffness over planet_bearing_stiffness_N_m"},
    {"gearbox", "planet_bearing_stiffness_scatter", number<&P::bearing_stiffness_scatter>, kNone, kNotNegative, planetary<bearings_move>, kRandom, "standard deviation of the logarithm of the planets' bearing stiffness, drawn for each"},
    {"gearbox", "planet_bearing_damping_factors", numbers<&P::bearing_damping>, kNone, kNotNegative, planetary<bearings_damp>, kShared, "each planet's bearing damping over planet_bearing_damping_N_s_m"},
    {"gearbox", "planet_bearing_damping_scatter", number<&P::bearing_damping_scatter>, kNone, kNotNegative, planetary<bearings_damp>, kRandom, "standard deviation of the logarithm of the planets' bearing damping, drawn for each"},
    {"gearbox", "planet_mass_factors", numbers<&P::mass>, kNone, kPositive, planetary<planet_masses>, kShared, "each planet's mass and inertia over those of a planet"},
    {"gearbox", "planet_mass_scatter", number<&P::mass_scatter>, kNone, kNotNegative, planetary<planet_masses>, kRandom, "standard deviation of the logarithm of the planets' masses, drawn for each"},
};
// clang-format on

}  // namespace

std::span<const Key> gearbox_keys() {
    return kKeys;
}

}  // namespace gearpod::mc
