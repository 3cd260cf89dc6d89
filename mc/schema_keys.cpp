// The table of keys. A new key is one member in study.hpp and one line here.
#include <array>
#include <limits>

#include "features/feature.hpp"
#include "mc/schema.hpp"
#include "mc/schema_access.hpp"
#include "mc/schema_presence.hpp"

namespace gearpod::mc {
namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr Unit kNone{"", "1", "", "1", 1.0};
constexpr Unit kMm{"mm", "mm", "m", "m", 1e-3};
constexpr Unit kDeg{"deg", "deg", "rad", "rad", kPi / 180};
constexpr Unit kArcsec{"arcsec", "arcsec", "rad", "rad", kPi / 648000};
constexpr Unit kPa{"Pa", "Pa", "Pa", "Pa", 1.0};
constexpr Unit kKg{"kg", "kg", "kg", "kg", 1.0};
constexpr Unit kKgM2{"kg_m2", "kg m^2", "kg_m2", "kg m^2", 1.0};
constexpr Unit kNPerM{"N_m", "N/m", "N_m", "N/m", 1.0};
constexpr Unit kNSPerM{"N_s_m", "N s/m", "N_s_m", "N s/m", 1.0};
constexpr Unit kNm{"N_m", "N m", "N_m", "N m", 1.0};
constexpr Unit kS{"s", "s", "s", "s", 1.0};
constexpr Unit kHz{"Hz", "Hz", "Hz", "Hz", 1.0};
constexpr Unit kRpm{"rpm", "rpm", "rad_s", "rad/s", kPi / 30};
constexpr Unit kMPerS2{"m_s2", "m/s^2", "m_s2", "m/s^2", 1.0};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kAny{};
constexpr Range kPositive{0.0, kInfinity, true, false};
constexpr Range kNotNegative{0.0, kInfinity, false, false};
// Above what converters sample; it also bounds the number of samples.
constexpr Range kFrequency{0.0, 1e7, true, false};
constexpr Range from_to(double low, double high) {
    return {low, high, false, false};
}
constexpr Range inside(double low, double high) {
    return {low, high, true, true};
}

constexpr std::string_view kRandom = "";  // may be random
constexpr std::string_view kGeometry = "it shapes the teeth, which all gearboxes share";
constexpr std::string_view kSampling = "all gearboxes are sampled alike";
constexpr std::string_view kShared = "all gearboxes share it";

template <class Enum>
constexpr ChoiceName name(std::string_view text, Enum value) {
    return {text, static_cast<int>(value)};
}
constexpr ChoiceName kKinds[] = {name("planetary", GearboxKind::planetary)};
constexpr ChoiceName kProfiles[] = {name("root-circle", ToothProfile::root_circle),
                                    name("base-circle", ToothProfile::base_circle),
                                    name("constant", ToothProfile::constant)};
constexpr ChoiceName kCentral[] = {name("ring", Member::ring), name("sun", Member::sun),
                                   name("carrier", Member::carrier)};
constexpr ChoiceName kToothed[] = {name("planet", Member::planet), name("sun", Member::sun),
                                   name("ring", Member::ring)};
constexpr ChoiceName kSides[] = {name("ring", Member::ring), name("sun", Member::sun)};
constexpr ChoiceName kMotions[] = {name("translational-torsional", Motion::translational_torsional),
                                   name("torsional", Motion::torsional)};
constexpr ChoiceName kDampings[] = {name("ratio", MeshDamping::ratio),
                                    name("proportional", MeshDamping::proportional),
                                    name("constant", MeshDamping::constant)};
constexpr ChoiceName kPaths[] = {name("hamming", PathWindow::hamming),
                                 name("hann", PathWindow::hann),
                                 name("rectangular", PathWindow::rectangular)};
constexpr ChoiceName kFaults[] = {name("none", FaultKind::none), name("crack", FaultKind::crack)};
constexpr ChoiceName kHorizons[] = {name("reuse", Horizon::reuse), name("march", Horizon::march)};
constexpr ChoiceName kInstructionSets[] = {
    name("auto", InstructionSet::automatic), name("baseline", InstructionSet::baseline),
    name("x86-64-v3", InstructionSet::x86_64_v3), name("x86-64-v4", InstructionSet::x86_64_v4)};

std::span<const ChoiceName> feature_names() {
    static const std::vector<ChoiceName> names = [] {
        std::vector<ChoiceName> all;
        for (const features::Feature& feature : features::all_features()) {
            all.push_back({feature.name, static_cast<int>(all.size())});
        }
        return all;
    }();
    return names;
}

using G = Gearbox;
using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

// clang-format off
const Key kKeys[] = {
    {"gearbox", "kind", choice<&G::kind>(kKinds), kNone, kAny, always, kShared, "kind of gearbox"},
    {"gearbox", "planets", integer<&G::planets>, kNone, from_to(2, 8), always, kGeometry, "number of planets, equally spaced"},
    {"gearbox", "sun_teeth", integer<&G::sun_teeth>, kNone, from_to(3, 10000), tooth_geometry, kGeometry, "teeth of the sun"},
    {"gearbox", "planet_teeth", integer<&G::planet_teeth>, kNone, from_to(3, 10000), tooth_geometry, kGeometry, "teeth of a planet"},
    {"gearbox", "ring_teeth", integer<&G::ring_teeth>, kNone, from_to(3, 10000), tooth_geometry, kGeometry, "teeth of the ring"},
    {"gearbox", "module_mm", number<&G::module_m>, kMm, kPositive, tooth_geometry, kGeometry, "module"},
    {"gearbox", "pressure_angle_deg", number<&G::pressure_angle_rad>, kDeg, inside(0, 45), always, kGeometry, "pressure angle"},
    {"gearbox", "face_width_mm", number<&G::face_width_m>, kMm, kPositive, tooth_geometry, kGeometry, "face width of all gears"},
    {"gearbox", "young_modulus_Pa", number<&G::young_modulus_Pa>, kPa, kPositive, tooth_geometry, kGeometry, "Young's modulus"},
    {"gearbox", "poisson_ratio", number<&G::poisson_ratio>, kNone, Range{0.0, 0.5, false, true}, tooth_geometry, kGeometry, "Poisson's ratio"},
    {"gearbox", "addendum_coefficient", number<&G::addendum_coefficient>, kNone, kPositive, may, kGeometry, "addendum over module"},
    {"gearbox", "dedendum_coefficient", number<&G::dedendum_coefficient>, kNone, kPositive, may, kGeometry, "dedendum over module"},
    {"gearbox", "tooth_profile", choice<&G::tooth_profile>(kProfiles), kNone, kAny, may, kShared, "where the tooth's beam begins, or constant mesh stiffness"},
    {"gearbox", "sun_planet_stiffness_N_m", number<&G::sun_planet_stiffness_N_m>, kNPerM, kPositive, constant_stiffness, kShared, "constant sun-planet mesh stiffness"},
    {"gearbox", "ring_planet_stiffness_N_m", number<&G::ring_planet_stiffness_N_m>, kNPerM, kPositive, constant_stiffness, kShared, "constant ring-planet mesh stiffness"},
    {"gearbox", "sun_mass_kg", number<&G::sun_mass_kg>, kKg, kPositive, always, kRandom, "mass of the sun"},
    {"gearbox", "planet_mass_kg", number<&G::planet_mass_kg>, kKg, kPositive, always, kRandom, "mass of a planet"},
    {"gearbox", "ring_mass_kg", number<&G::ring_mass_kg>, kKg, kPositive, always, kRandom, "mass of the ring"},
    {"gearbox", "carrier_mass_kg", number<&G::carrier_mass_kg>, kKg, kPositive, always, kRandom, "mass of the carrier"},
    {"gearbox", "sun_inertia_kg_m2", number<&G::sun_inertia_kg_m2>, kKgM2, kPositive, inertia, kRandom, "moment of inertia J of the sun; a solid disc by default"},
    {"gearbox", "planet_inertia_kg_m2", number<&G::planet_inertia_kg_m2>, kKgM2, kPositive, inertia, kRandom, "moment of inertia J of a planet"},
    {"gearbox", "ring_inertia_kg_m2", number<&G::ring_inertia_kg_m2>, kKgM2, kPositive, inertia, kRandom, "moment of inertia J of the ring"},
    {"gearbox", "carrier_inertia_kg_m2", number<&G::carrier_inertia_kg_m2>, kKgM2, kPositive, inertia, kRandom, "moment of inertia J of the carrier"},
    {"gearbox", "sun_inertia_over_r2_kg", number<&G::sun_inertia_over_r2_kg>, kKg, kPositive, inertia_over_r2, kRandom, "J over base radius squared, sun"},
    {"gearbox", "planet_inertia_over_r2_kg", number<&G::planet_inertia_over_r2_kg>, kKg, kPositive, inertia_over_r2, kRandom, "J over base radius squared, planet"},
    {"gearbox", "ring_inertia_over_r2_kg", number<&G::ring_inertia_over_r2_kg>, kKg, kPositive, inertia_over_r2, kRandom, "J over base radius squared, ring"},
    {"gearbox", "carrier_inertia_over_r2_kg", number<&G::carrier_inertia_over_r2_kg>, kKg, kPositive, inertia_over_r2, kRandom, "J over centre distance squared, carrier"},
    {"gearbox", "sun_bearing_stiffness_N_m", number<&G::sun_bearing_stiffness_N_m>, kNPerM, kNotNegative, bearing, kRandom, "radial bearing stiffness of the sun"},
    {"gearbox", "planet_bearing_stiffness_N_m", number<&G::planet_bearing_stiffness_N_m>, kNPerM, kNotNegative, bearing, kRandom, "radial bearing stiffness of a planet"},
    {"gearbox", "ring_bearing_stiffness_N_m", number<&G::ring_bearing_stiffness_N_m>, kNPerM, kNotNegative, bearing, kRandom, "radial bearing stiffness of the ring"},
    {"gearbox", "carrier_bearing_stiffness_N_m", number<&G::carrier_bearing_stiffness_N_m>, kNPerM, kNotNegative, bearing, kRandom, "radial bearing stiffness of the carrier"},
    {"gearbox", "sun_bearing_damping_N_s_m", number<&G::sun_bearing_damping_N_s_m>, kNSPerM, kNotNegative, may, kRandom, "radial bearing damping of the sun"},
    {"gearbox", "planet_bearing_damping_N_s_m", number<&G::planet_bearing_damping_N_s_m>, kNSPerM, kNotNegative, may, kRandom, "radial bearing damping of a planet"},
    {"gearbox", "ring_bearing_damping_N_s_m", number<&G::ring_bearing_damping_N_s_m>, kNSPerM, kNotNegative, may, kRandom, "radial bearing damping of the ring"},
    {"gearbox", "carrier_bearing_damping_N_s_m", number<&G::carrier_bearing_damping_N_s_m>, kNSPerM, kNotNegative, may, kRandom, "radial bearing damping of the carrier"},
    {"gearbox", "support_stiffness_N_m", number<&G::support_stiffness_N_m>, kNPerM, kPositive, always, kRandom, "tangential stiffness that holds the fixed member"},
    {"gearbox", "support_damping_N_s_m", number<&G::support_damping_N_s_m>, kNSPerM, kNotNegative, may, kRandom, "tangential damping of the fixed member"},
    {"gearbox", "mesh_damping_ratio", number<&G::mesh_damping_ratio>, kNone, kNotNegative, damping_ratio, kRandom, "zeta of c = 2 zeta sqrt(k m1 m2 / (m1 + m2))"},
    {"gearbox", "mesh_damping_time_s", number<&G::mesh_damping_time_s>, kS, kNotNegative, damping_time, kRandom, "mu of c = mu k"},
    {"gearbox", "mesh_damping_N_s_m", number<&G::mesh_damping_N_s_m>, kNSPerM, kNotNegative, damping_constant, kRandom, "constant mesh damping"},

    {"operation", "fixed", choice<&Operation::fixed>(kCentral), kNone, kAny, may, kShared, "member that stands still"},
    {"operation", "input", choice<&Operation::input>(kCentral), kNone, kAny, may, kShared, "member that is driven: the sun, or the ring if the sun is fixed; either if the carrier is"},
    {"operation", "torque_N_m", number<&Operation::torque_N_m>, kNm, kNotNegative, always, kRandom, "torque on the sun, or on the ring if the sun is fixed"},
    {"operation", "sun_speed_rpm", number<&Operation::sun_speed_rad_s>, kRpm, kPositive, may, kRandom, "speed of the sun"},
    {"operation", "ring_speed_rpm", number<&Operation::ring_speed_rad_s>, kRpm, kPositive, may, kRandom, "speed of the ring"},
    {"operation", "carrier_speed_rpm", number<&Operation::carrier_speed_rad_s>, kRpm, kPositive, may, kRandom, "speed of the carrier"},

    {"effects", "motion", choice<&Effects::motion>(kMotions), kNone, kAny, may, kShared, "degrees of freedom"},
    {"effects", "inertial_terms", boolean<&Effects::inertial_terms>, kNone, kAny, may, kShared, "Coriolis and centrifugal terms of the turning carrier"},
    {"effects", "mesh_damping", choice<&Effects::mesh_damping>(kDampings), kNone, kAny, may, kShared, "law of mesh damping"},
    {"effects", "path", choice<&Effects::path>(kPaths), kNone, kAny, may, kShared, "window of the transmission path"},

    {"fault", "kind", choice<&Fault::kind>(kFaults), kNone, kAny, always, kShared, "kind of fault"},
    {"fault", "member", choice<&Fault::member>(kToothed), kNone, kAny, crack, kShared, "gear with the faulty tooth"},
    {"fault", "side", choice<&Fault::side>(kSides), kNone, kAny, planet_side, kShared, "mesh in which a planet's crack opens"},
    {"fault", "planet", integer<&Fault::planet>, kNone, from_to(1, 8), planet_number, kShared, "number of the faulty planet"},
    {"fault", "depth_mm", number<&Fault::depth_m>, kMm, kNotNegative, crack, kRandom, "crack depth along the crack"},
    {"fault", "angle_deg", number<&Fault::angle_rad>, kDeg, inside(0, 90), may, "the tables of cracked teeth hold for one angle", "angle between crack and tooth centre line"},

    {"sensor", "sampling_Hz", number<&Sensor::sampling_Hz>, kHz, kFrequency, always, kSampling, "sampling rate of the accelerometer"},
    {"sensor", "low_pass_Hz", number<&Sensor::low_pass_Hz>, kHz, kFrequency, always, kSampling, "anti-alias low-pass"},
    {"sensor", "path_exponent", number<&Sensor::path_exponent>, kNone, from_to(-1, 1), may, kRandom, "exponent of the transmission path"},
    {"sensor", "noise_m_s2", number<&Sensor::noise_m_s2>, kMPerS2, kNotNegative, may, kRandom, "rms noise of the accelerometer"},
    {"sensor", "encoder_sampling_Hz", number<&Sensor::encoder_sampling_Hz>, kHz, kFrequency, always, kSampling, "sampling rate of the encoders"},
    {"sensor", "encoder_noise_arcsec", number<&Sensor::encoder_noise_rad>, kArcsec, kNotNegative, may, kRandom, "rms noise of the transmission error"},
    {"sensor", "noise_levels", list<&Sensor::noise_levels, Numbers>, kNone, kNotNegative, may, kSampling, "factors on both noises, ascending"},

    {"features", "use", list<&Features::use, Texts>, kNone, kAny, may, kShared, "features to compute; all by default"},
    {"features", "tukey_taper", number<&Features::tukey_taper>, kNone, from_to(0, 1), may, kShared, "tapered fraction of the mesh window"},
    {"features", "te_harmonics", integer<&Features::te_harmonics>, kNone, from_to(1, 1000), may, kShared, "mesh harmonics in te_fm0"},

    {"detection", "false_alarm_rate", number<&Detection::false_alarm_rate>, kNone, inside(0, 1), may, kShared, "share of healthy gearboxes that may alarm"},
    {"detection", "confidence", number<&Detection::confidence>, kNone, inside(0, 1), may, kShared, "confidence of the intervals"},
    {"detection", "size_edges_mm", list<&Detection::size_edges_m, Numbers>, kMm, kNotNegative, may, kShared, "edges of the size groups of a continuous fault.depth_mm"},

    {"numerics", "steps_per_mesh", integer<&Numerics::steps_per_mesh>, kNone, from_to(0, 1e6), may, kShared, "time steps in a mesh period; 0: as many as a pilot of the ensemble needs"},
    {"numerics", "settle_tolerance", number<&Numerics::settle_tolerance>, kNone, inside(0, 1), may, kShared, "relative change at which an orbit has settled"},
    {"numerics", "max_meshes", integer<&Numerics::max_meshes>, kNone, from_to(0, 1e6), may, kShared, "mesh periods in which it must settle; 0: from the damping"},
    {"numerics", "horizon", choice<&Numerics::horizon>(kHorizons), kNone, kAny, may, kShared, "reuse settled meshes, or march them all"},
    {"numerics", "lanes", integer<&Numerics::lanes>, kNone, from_to(1, 8), may, kShared, "gearboxes in lockstep: 8 or 1"},
    {"numerics", "threads", integer<&Numerics::threads>, kNone, from_to(0, 65536), may, kShared, "threads; 0 for all"},
    {"numerics", "instruction_set", choice<&Numerics::instruction_set>(kInstructionSets), kNone, kAny, may, kShared, "instruction set of the kernels"},

    {"ensemble", "instances", integer<&Ensemble::instances>, kNone, from_to(1, 1e9), always, kShared, "gearboxes over all fault sizes"},
    {"ensemble", "threshold_instances", integer<&Ensemble::threshold_instances>, kNone, from_to(1, 1e9), always, kShared, "further healthy gearboxes that set the thresholds"},
    {"ensemble", "seed", integer<&Ensemble::seed>, kNone, kNotNegative, always, kShared, "seed of all random numbers"},
    {"ensemble", "checkpoint_s", number<&Ensemble::checkpoint_s>, kS, from_to(0, 1e6), may, kShared, "seconds between two checkpoints"},
    {"ensemble", "until.half_width", number<&Until::half_width>, kNone, inside(0, 0.5), may, kShared, "stop once Pd is known within this half width of its interval"},
    {"ensemble", "until.feature", choice<&Until::feature>(feature_names()), kNone, kAny, until_part, kShared, "feature whose Pd that is"},
    {"ensemble", "until.size", number<&Until::size>, kNone, kNotNegative, until_part, kShared, "fault size whose Pd that is, in the unit of the fault's size"},
    {"ensemble", "until.noise_level", number<&Until::noise_level>, kNone, kNotNegative, until_level, kShared, "noise level of that Pd, one of sensor.noise_levels"},
};
// clang-format on

}  // namespace

std::span<const Key> schema() {
    return kKeys;
}

}  // namespace gearpod::mc
