// A study: everything a study file (TOML) says, checked, in SI units and radians.
// The keys, their units, defaults and ranges are the table in schema_keys.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mc/distribution.hpp"
#include "mc/problems.hpp"

namespace gearpod::mc {

enum class GearboxKind { planetary };
enum class ToothProfile { root_circle, base_circle, constant };
enum class Member { sun, planet, ring, carrier };
enum class Motion { translational_torsional, torsional };
enum class MeshDamping { ratio, proportional, constant };
enum class PathWindow { hamming, hann, rectangular };
enum class FaultKind { none, crack };
enum class Horizon { reuse, march };
enum class InstructionSet { automatic, baseline, x86_64_v3, x86_64_v4 };

// Inputs that may be random hold their nominal value: the value in its section, else the
// distribution's median. An empty optional means "not given".
struct Gearbox {
    GearboxKind kind = GearboxKind::planetary;
    int planets = 0;
    // All three or none; without them only the modes of a constant-stiffness gearbox are defined.
    std::optional<int> sun_teeth, planet_teeth, ring_teeth;
    std::optional<double> module_m;
    double pressure_angle_rad = 0.0;
    std::optional<double> face_width_m, young_modulus_Pa, poisson_ratio;
    double addendum_coefficient = 1.0;
    double dedendum_coefficient = 1.25;
    ToothProfile tooth_profile = ToothProfile::root_circle;
    std::optional<double> sun_planet_stiffness_N_m, ring_planet_stiffness_N_m;  // constant profile
    double sun_mass_kg = 0.0, planet_mass_kg = 0.0, ring_mass_kg = 0.0, carrier_mass_kg = 0.0;
    // J, or J / r^2 (r: base radius; carrier: centre distance), or neither (solid disc).
    std::optional<double> sun_inertia_kg_m2, planet_inertia_kg_m2, ring_inertia_kg_m2,
        carrier_inertia_kg_m2;
    std::optional<double> sun_inertia_over_r2_kg, planet_inertia_over_r2_kg,
        ring_inertia_over_r2_kg, carrier_inertia_over_r2_kg;
    std::optional<double> sun_bearing_stiffness_N_m, planet_bearing_stiffness_N_m,
        ring_bearing_stiffness_N_m, carrier_bearing_stiffness_N_m;
    double sun_bearing_damping_N_s_m = 0.0, planet_bearing_damping_N_s_m = 0.0,
           ring_bearing_damping_N_s_m = 0.0, carrier_bearing_damping_N_s_m = 0.0;
    double support_stiffness_N_m = 0.0;  // tangential, holds the fixed member
    double support_damping_N_s_m = 0.0;
    std::optional<double> mesh_damping_ratio, mesh_damping_time_s, mesh_damping_N_s_m;

    bool has_teeth() const { return sun_teeth && planet_teeth && ring_teeth; }
    bool operator==(const Gearbox&) const = default;
};

struct Operation {
    Member fixed = Member::ring;
    Member input = Member::sun;  // in a file by default the ring if the sun is fixed
    double torque_N_m = 0.0;     // >= 0; on the sun; on the ring if the sun is fixed
    std::optional<double> sun_speed_rad_s, ring_speed_rad_s, carrier_speed_rad_s;  // exactly one

    bool operator==(const Operation&) const = default;
};

struct Effects {
    Motion motion = Motion::translational_torsional;
    bool inertial_terms = true;
    MeshDamping mesh_damping = MeshDamping::ratio;
    PathWindow path = PathWindow::hamming;

    bool operator==(const Effects&) const = default;
};

struct Fault {
    FaultKind kind = FaultKind::none;
    std::optional<Member> member;            // sun, planet or ring
    std::optional<Member> side;              // of a planet tooth: ring or sun
    int planet = 1;                          // 1..planets
    std::optional<double> depth_m;           // along the crack
    double angle_rad = 0.78539816339744828;  // 45 degrees, Liang (2016), section 3.1

    bool operator==(const Fault&) const = default;
};

struct Sensor {
    double sampling_Hz = 0.0;
    double low_pass_Hz = 0.0;
    double path_exponent = 0.1;
    double noise_m_s2 = 0.0;  // rms
    double encoder_sampling_Hz = 0.0;
    double encoder_noise_rad = 0.0;         // rms
    std::vector<double> noise_levels{1.0};  // factors on both noises, ascending

    bool operator==(const Sensor&) const = default;
};

struct Features {
    std::vector<std::string> use;  // as in the file; all known ones by default
    double tukey_taper = 0.1;
    int te_harmonics = 8;

    bool operator==(const Features&) const = default;
};

struct Detection {
    double false_alarm_rate = 0.05;
    double confidence = 0.95;
    std::vector<double> size_edges_m;  // ascending; only for a continuous fault depth

    bool operator==(const Detection&) const = default;
};

struct Numerics {
    int steps_per_mesh = 0;  // 0: chosen from a pilot of the ensemble
    double settle_tolerance = 1e-10;
    int max_meshes = 0;  // 0: from the damping
    Horizon horizon = Horizon::reuse;
    int lanes = 8;    // 8 or 1
    int threads = 0;  // 0: all
    InstructionSet instruction_set = InstructionSet::automatic;

    bool operator==(const Numerics&) const = default;
};

// When a detection rate is known well enough to stop; never without a half_width.
struct Until {
    std::optional<double> half_width;  // of the interval of Pd
    std::optional<int> feature;        // place in features::all_features()
    std::optional<double> size;        // of the fault, in the unit of its key
    double noise_level = 1.0;

    bool operator==(const Until&) const = default;
};

struct Ensemble {
    std::int64_t instances = 0;            // gearboxes over all fault sizes
    std::int64_t threshold_instances = 0;  // further healthy gearboxes that set the thresholds
    std::int64_t seed = 0;                 // 0..2^63-1
    double checkpoint_s = 30.0;            // how often finished gearboxes are made safe
    Until until;

    bool operator==(const Ensemble&) const = default;
};

struct RandomInput {
    std::string key;            // "gearbox.planet_bearing_stiffness_N_m"
    std::string unit;           // of the key and of the distribution, e.g. "N/m"
    Distribution distribution;  // in that unit
    double to_si = 1.0;         // SI value = drawn value * to_si

    bool operator==(const RandomInput&) const = default;
};

struct Study {
    std::string title;
    Gearbox gearbox;
    Operation operation;
    Effects effects;
    Fault fault;
    Sensor sensor;
    Features features;
    Detection detection;
    Numerics numerics;
    Ensemble ensemble;
    std::vector<RandomInput> random;  // in the order of the schema

    // The random input of that key, or nullptr.
    const RandomInput* find_random(const std::string& key) const;
    bool operator==(const Study&) const = default;
};

struct StudyReading {
    std::optional<Study> study;  // only without problems
    Problems problems;           // sorted
};

// Reads a study file. Each override is "section.key=value" with a TOML value (a bare word is a
// string) and replaces what the file says. An override of section.key also drops what [random] says
// of that key: all gearboxes then have the value given. An override of random.section.key leaves
// the value in its section, which is nominal; given together with one of section.key, in whatever
// order, it wins. Bad input of any kind ends in `problems`, never in an exception.
StudyReading read_study(const std::string& path, const std::vector<std::string>& overrides = {});

// The same from text; `name` stands for the file in messages.
StudyReading read_study_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides = {});

// The complete study as TOML, defaults spelled out. Reads back to the same study, bit for bit.
std::string resolved_text(const Study& study);

}  // namespace gearpod::mc
