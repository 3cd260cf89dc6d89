// Feature of a study that a function in a Python file computes.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeindex>
#include <typeinfo>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/integrator.hpp"
#include "machine/contracts.hpp"
#include "machine/instruction_sets.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/python_hashes.hpp"
#include "mc/study/distributions/distribution.hpp"
#include "mc/study/member.hpp"
#include "mc/study/sensor.hpp"
#include "signals/path/transmission_path.hpp"
#include "stiffness/contact/load_sharing.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::features {
struct Feature;
}

namespace gearpod::mc {

struct PythonFeature {
    std::string file;  // absolute path
    PythonHashes hashes;
    const features::Feature* feature = nullptr;  // external

    bool operator==(const PythonFeature&) const = default;
};

// Numerical settings of a study.

using lockstep::Precision;
enum class StepGrid { uniform, graded };
// Strategy of time integration. `periodic`: the periodic orbit and a fault's passages are
// integrated. `superposed`: the effect of each gear's tooth errors is integrated separately, as
// long as no tooth pair loses contact. `full`: every mesh period is integrated.
enum class Horizon { periodic, superposed, full };

// Number of lanes that fill a 512-bit register.
constexpr int full_lanes(Precision precision) {
    return precision == Precision::single_precision ? 16 : 8;
}

// Fewest healthy and faulty gearboxes from which the error of the steps is fitted.
inline constexpr int kFewestPairs = 8;

struct Numerics {
    std::optional<lockstep::Integrator> integrator;  // empty: chosen by the program
    Precision precision = Precision::double_precision;
    StepGrid grid = StepGrid::uniform;
    double grid_tolerance = 1e-3;  // rms error of the signals on a graded grid
    int steps_per_mesh = 0;        // 0: chosen from pilot gearboxes of the ensemble
    // Relative tolerance of every feature, from which integrator, steps and convergence tolerance
    // are chosen; 0: they are not chosen.
    double tolerance = 0.0;
    // Error of every feature over its scatter between healthy gearboxes, for which the steps and
    // mass_scaling_Hz are chosen; 0: they are not chosen.
    double scatter_tolerance = 0.0;
    bool verify = false;  // repeat some gearboxes with finer steps; always with a tolerance
    int paired_gearboxes =
        0;  // healthy and faulty ones each that are repeated; 0: eight faulty ones
    // Natural frequency to which faster modes of the nominal gearbox are lowered by additional
    // inertia (lockstep/plan/mode_inertia.hpp); 0: none.
    double mass_scaling_Hz = 0.0;
    double convergence_tolerance = 1e-10;
    double stiffness_tolerance = 0.0;  // of the stiffness curves; 0: the smallest that is possible
    int max_meshes = 0;                // 0: derived from the damping
    Horizon horizon = Horizon::periodic;
    int lanes = full_lanes(Precision::double_precision);     // 16 (single only), 8, 4 or 1
    int threads = 0;                                         // 0: all
    std::optional<machine::InstructionSet> instruction_set;  // empty: the processor's widest set

    bool operator==(const Numerics&) const = default;
};

// Section [life]: gearboxes that are measured repeatedly while a crack grows.

// Lives of gearboxes that are measured repeatedly while a crack grows. Absent without interval_h.
struct Life {
    std::optional<double> interval_h;  // between records
    int records = 200;        // largest number of records of a life, baseline records included
    int healthy_lives = 100;  // used to count false alarms, not to set thresholds
    // Depth of the crack when the baseline is known, and depth at which a life ends.
    std::optional<double> first_depth_m, last_depth_m;
    // Replaces the first depth and Paris' law: hours since the crack started and its depth then,
    // linear in between. One hour of a gearbox is `curve_pace` hours of the curve.
    std::vector<double> curve_h, curve_depth_m;
    std::optional<double> curve_pace;
    // Paris' law: C in mm a cycle at 1 MPa m^(1/2), and m.
    std::optional<double> paris_factor, paris_exponent;
    // Number of depth steps from 0 to the last depth. A gearbox is integrated at their ends;
    // signals in between are interpolated.
    int depth_steps = 8;
    // Scatter of a record about its gearbox's value: standard deviation of the logarithm. Short
    // form of the record distributions of torque, speed, gain and noise in [random].
    double torque_scatter = 0.0, speed_scatter = 0.0, gain_scatter = 0.0, noise_scatter = 0.0;
    // Number of torques and speeds at which a gearbox is integrated if its records' values differ,
    // by default as many as interpolation_tolerance needs. One polynomial through them gives the
    // signals in between (superposition.hpp).
    std::optional<int> polynomial_torques, polynomial_speeds;
    // Instead of that: number of torques and speeds, equally frequent, that records have at all.
    std::optional<int> distinct_torques, distinct_speeds;
    // Largest error of signals between them, relative to the change made by a crack of
    // smallest_depth_m(). Numbers that are not given are raised until pilots keep it.
    double interpolation_tolerance = 0.1;
    // Length of a recording, by default that of [sensor]. A record averages `recordings`
    // recordings.
    std::optional<double> record_s;
    int recordings = 1;

    bool operator==(const Life&) const = default;
};
// Crack whose effect is the unit of the interpolation error: half the last depth.
inline double smallest_depth_m(const Life& life) {
    EXPECTS(life.last_depth_m);
    return 0.5 * *life.last_depth_m;
}
// Depth of the crack at the start of a life.
double crack_begin_m(const Life& life);

// Random inputs of the section [random]: their distributions and correlations.

// Kinds of random inputs that are treated in different ways: those of the sensor do not change the
// motion, and the fault size is 0 in healthy gearboxes.
enum class InputKind { other, sensor, fault_size };
// Quantities that may vary from record to record.
enum class RecordQuantity { torque, speed, gain, noise };

struct RandomInput {
    std::string key;            // "gearbox.planet.bearing_stiffness_N_m"
    std::string unit;           // of the key, e.g. "N/m"
    Distribution distribution;  // SI
    InputKind kind = InputKind::other;
    std::optional<RecordQuantity> quantity;

    bool operator==(const RandomInput&) const = default;
};

// Rank correlation (Spearman's) of two random inputs.
struct Correlation {
    std::string first, second;  // keys of random inputs
    double rank = 0.0;

    bool operator==(const Correlation&) const = default;
};

// Study: the content of a study file (TOML), checked, in SI units and radians. The table in
// schema/*_keys.cpp lists the keys with units, defaults and ranges.

class FaultKind;  // mc/study/faults/fault_kind.hpp

enum class GearboxKind { planetary, fixed_shaft };
// Source of the mesh stiffness: beams with a tooth profile, or given values.
enum class StiffnessSource { root_circle, base_circle, fillet, constant, square_wave };
enum class MeshKind { sun_planet, ring_planet, pinion_gear };
inline constexpr std::size_t kMeshKinds = 3;
enum class Motion { translational_torsional, torsional, quasi_static, quasi_static_torsional };
enum class Separation { none, one_sided, two_sided };
// Start and end of tooth contact: with the nominal path, or also at the tip corners beyond it.
enum class ContactOnset { abrupt, extended };
using Foundation = stiffness::FoundationModel;
using dynamics::MeshDamping;
using stiffness::Contact;
using FaultSide = lockstep::PlanetSide;

template <class Value>
using MeshArray = EnumArray<MeshKind, kMeshKinds, Value>;

// Inputs that may be random store their nominal value: the value in its section, else the
// distribution's median. An empty optional means "not given".

// Properties of one body of a gearbox.
struct MemberValues {
    std::optional<int> teeth;
    std::optional<double> profile_shift;   // in modules; positive: thicker teeth, also for the ring
    std::optional<double> tip_diameter_m;  // if not given, from addendum and shift
    // Amounts removed from every flank; lengths along the line of action from the end of contact.
    std::optional<double> tip_relief_m, tip_relief_length_m;
    std::optional<double> crowning_m;
    // Diameter of the bore, or outer diameter of a ring, where the gear body is held.
    std::optional<double> held_diameter_m;
    // Gear blank that is no solid disc: thickness of the rim below the teeth's roots and of the web
    // under it.
    std::optional<double> rim_m, web_m;
    std::optional<double> mass_kg;
    // Moment of inertia J, or J / r^2 (r: base radius; carrier: centre distance); if neither is
    // given, that of a solid disc.
    std::optional<double> inertia_kg_m2, inertia_over_r2_kg;
    std::optional<double> bearing_stiffness_N_m;
    double bearing_damping_N_s_m = 0.0;
    std::optional<double> quality;  // ISO 1328 grade of its teeth; overrides that of all gears
    // Measured index deviations that replace random ones, tooth by tooth, gaps positive. For
    // planets one planet after the other; ring_side_index_m is that of the flanks that meet the
    // ring.
    std::vector<double> index_m, ring_side_index_m;

    bool operator==(const MemberValues&) const = default;
};

// Given stiffness and static transmission error of the meshes of one kind.
struct MeshValues {
    std::optional<double> stiffness_N_m;                                         // constant
    std::optional<double> low_stiffness_N_m, high_stiffness_N_m, contact_ratio;  // square wave
    // Error along the line of action: amplitude and phase of mesh harmonics 1, 2, ...; phases are
    // as many as amplitudes, or none (all 0).
    std::vector<double> error_m = {}, error_phase_rad = {};

    bool operator==(const MeshValues&) const = default;
};

// Properties of both kinds of gearbox, and those of the planetary one.
struct Gearbox {
    GearboxKind kind = GearboxKind::planetary;
    int planets = 0;
    MemberArray<MemberValues> bodies;
    MeshArray<MeshValues> meshes;
    std::vector<double> planet_positions_rad;         // ascending from 0; empty: equally spaced
    std::optional<double> module_m, normal_module_m;  // transverse, or normal (helical)
    std::optional<double> centre_distance_m;          // working centre distance
    double pressure_angle_rad = 0.0;
    double helix_angle_rad = 0.0;
    std::optional<double> face_width_m, young_modulus_Pa, poisson_ratio;
    double addendum_coefficient = 1.0;
    double dedendum_coefficient = 1.25;
    StiffnessSource tooth_profile = StiffnessSource::root_circle;
    std::optional<double> ring_to_sun_phase;  // mesh periods; by default from the geometry
    double support_stiffness_N_m = 0.0;       // tangential, holds the fixed member
    double support_damping_N_s_m = 0.0;
    // Parameter of each mesh-damping law.
    EnumArray<MeshDamping, dynamics::kMeshDampings, std::optional<double>> mesh_damping;
    std::optional<double> backlash_m;  // 2b along the line of action

    // Module in the transverse plane.
    std::optional<double> transverse_module_m() const {
        return normal_module_m ? *normal_module_m / std::cos(helix_angle_rad) : module_m;
    }

    // True if the tooth numbers of a planetary gearbox are given: all three, or none. Without them
    // only the modes of a constant-stiffness gearbox are defined.
    bool has_teeth() const {
        return bodies[Member::sun].teeth && bodies[Member::planet].teeth &&
               bodies[Member::ring].teeth;
    }
    bool operator==(const Gearbox&) const = default;
};

// Properties of a fixed-shaft gearbox: motor, coupling, pinion, gear, coupling, load. Tian (2004),
// Table 4.1.
struct FixedShaft {
    std::optional<double> motor_inertia_kg_m2, load_inertia_kg_m2;
    double motor_coupling_stiffness_N_m_rad = 0.0, load_coupling_stiffness_N_m_rad = 0.0;
    double motor_coupling_damping_N_m_s_rad = 0.0, load_coupling_damping_N_m_s_rad = 0.0;

    bool operator==(const FixedShaft&) const = default;
};

// Random tooth deviations: an ISO 1328 grade, and additional rms deviations along the line of
// action (gears::DeviationScales).
struct ToothErrors {
    std::optional<double> tooth_quality;
    double pitch_error_m = 0.0, eccentricity_m = 0.0;

    bool operator==(const ToothErrors&) const = default;
};

// Differences between the planets of a planetary gearbox: given for each planet (empty: none), and
// random.
struct PlanetDifferences {
    std::vector<double> pin_tangential_m, pin_radial_m;  // deviations from the nominal positions
    double pin_tangential_rms_m = 0.0, pin_radial_rms_m = 0.0;  // of normal distributions

    bool operator==(const PlanetDifferences&) const = default;
};

struct Operation {
    // Planetary.
    Member fixed = Member::ring;
    Member input = Member::sun;      // in a file by default the ring if the sun is fixed
    Member torque_on = Member::sun;  // in a file by default the ring if the sun is fixed
    double torque_N_m = 0.0;         // >= 0; on torque_on, or the motor's
    std::optional<double> sun_speed_rad_s, carrier_speed_rad_s;  // exactly one
    // Fixed-shaft.
    std::optional<double> load_torque_N_m;  // by default in balance with the motor's
    std::optional<double> pinion_speed_rad_s;

    bool operator==(const Operation&) const = default;
};

// Relative fluctuation about the means: noise of torque and speed with a spectrum that has fallen
// to half at its band (lockstep/plan/excitation.hpp), and a sine of the speed.
struct Fluctuations {
    std::optional<double> torque_noise, torque_noise_Hz;  // rms and band; of all torques
    std::optional<double> speed;                          // amplitude
    std::optional<double> speed_order;                    // per input turn
    double speed_phase_rad = 0.0;
    std::optional<double> speed_noise, speed_noise_Hz;

    bool operator==(const Fluctuations&) const = default;
};

struct Effects {
    Motion motion = Motion::translational_torsional;
    Foundation foundation = Foundation::none;
    Contact contact = Contact::linear;
    bool shear = true;  // shear energy of the teeth
    Separation separation = Separation::none;
    ContactOnset contact_onset = ContactOnset::abrupt;
    bool inertial_terms = true;
    MeshDamping mesh_damping = MeshDamping::ratio;
    bool gravity = false;
    // Null if no transmission path leads to a sensor; the reader's default for fixed-shaft and
    // quasi-static gearboxes.
    const signals::PathWindow* path = &signals::path_window("hamming");

    bool quasi_static() const {
        return motion == Motion::quasi_static || motion == Motion::quasi_static_torsional;
    }
    // True if the bodies have rotations only.
    bool torsional() const {
        return motion == Motion::torsional || motion == Motion::quasi_static_torsional;
    }
    bool operator==(const Effects&) const = default;
};

// Fault parameters of a study, by kind of fault. Each kind has a struct that only its own file
// knows.

// Base of a fault kind's parameter struct, which must be copyable, comparable and
// default-constructible.
struct FaultShape {
    bool operator==(const FaultShape&) const = default;
};

// Heterogeneous map from parameter type to value. Copies share the values until one of them edits
// it.
class FaultShapes {
  public:
    // Value as last edited, or a default-constructed one.
    template <std::derived_from<FaultShape> Shape>
    const Shape& get() const {
        static const Shape defaults{};
        const auto found = held_.find(typeid(Shape));
        return found == held_.end() ? defaults
                                    : static_cast<const Holder<Shape>&>(*found->second).shape;
    }
    // Reference for changing the value, valid until the next call of edit() for the same type.
    template <std::derived_from<FaultShape> Shape>
    Shape& edit() {
        auto own = std::make_shared<Holder<Shape>>(get<Shape>());
        Shape& shape = own->shape;
        held_[typeid(Shape)] = std::move(own);
        return shape;
    }
    bool operator==(const FaultShapes& other) const {
        return all_same_in(other) && other.all_same_in(*this);
    }

  private:
    struct Held {
        virtual ~Held() = default;
        virtual bool same_in(const FaultShapes& other) const = 0;
    };
    template <class Shape>
    struct Holder final : Held {
        explicit Holder(const Shape& from) : shape(from) {}
        bool same_in(const FaultShapes& other) const override {
            return shape == other.get<Shape>();
        }
        Shape shape;
    };

    bool all_same_in(const FaultShapes& other) const {
        for (const auto& [type, held] : held_) {
            if (!held->same_in(other)) {
                return false;
            }
        }
        return true;
    }

    std::map<std::type_index, std::shared_ptr<const Held>> held_;
};

// Fault of a study. Parameters of a kind are defined in its own file (mc/study/faults).
struct Fault {
    const FaultKind* kind = nullptr;   // one of all_faults(); null without a fault
    std::optional<Member> member;      // one of the gearbox's toothed members
    FaultSide side = FaultSide::ring;  // of a planet tooth
    int planet = 1;                    // 1..planets
    FaultShapes shapes;

    bool operator==(const Fault&) const = default;
};

struct Features {
    std::vector<std::string>
        use;  // as in the file, by default the basic ones; then those in Python
    std::vector<PythonFeature> python;
    double tukey_taper = 0.1;
    int te_harmonics = 8;
    // Standard deviation of the logarithm of the torque in a gearbox's baseline record, normal
    // about that of its test record.
    double baseline_torque_scatter = 0.0;
    int baseline_records = 1;  // number of baseline records that are averaged
    // Properties of an assembly that are drawn again for that of the baseline: "pins", "teeth".
    std::vector<std::string> baseline_redraws;

    bool operator==(const Features&) const = default;
};

struct Detection {
    double false_alarm_rate = 0.05;  // of one record; resolved from the user's target, if given
    // Target in time; the number of machines that share it, and the time between two records of a
    // machine.
    std::optional<double> false_alarms_per_1000_h;
    int machines = 1;
    std::optional<double> record_interval_h;
    double confidence = 0.95;
    // Ascending. At most one of the two, and only for a continuous fault size: a length, or a pure
    // number.
    std::vector<double> size_edges_m, size_edges;
    // Keys of random inputs that have one unknown value common to all gearboxes and do not vary
    // among them.
    std::vector<std::string> uncertain_inputs;
    // Keys of assumptions that are neither measured nor from a source; the answer marks them.
    std::vector<std::string> chosen_values;

    bool operator==(const Detection&) const = default;
};

// Monitoring of a gearbox that is measured repeatedly (analysis/monitoring).
struct Monitoring {
    // Number of first records of each gearbox, from which its normal state is estimated; or 0.
    int baseline_records = 20;
    bool torque_regression = false;      // the normal state depends linearly on the records' torque
    std::vector<std::string> detectors;  // as in the file; by default the usual ones
    double false_alarms_per_1000_h = 5.0;  // allowed rate of false alarms in lives
    int average_records = 1;  // consecutive measured recordings that are averaged before features

    bool operator==(const Monitoring&) const = default;
};

struct Ensemble {
    std::int64_t instances = 0;               // gearboxes over all fault sizes
    std::int64_t threshold_instances = 0;     // further healthy gearboxes that set the thresholds
    int threshold_records = 1;                // records of each of those, with independent noise
    std::optional<bool> importance_sampling;  // most records with exponentially tilted noise
    std::int64_t seed = 0;                    // 0..2^63-1
    double checkpoint_s = 30.0;               // interval of writing finished gearboxes to disk

    bool uses_importance_sampling() const { return importance_sampling.value_or(false); }
    bool operator==(const Ensemble&) const = default;
};

struct Study {
    std::string title;
    Gearbox gearbox;
    FixedShaft fixed_shaft;
    ToothErrors errors;
    PlanetDifferences planets;
    Operation operation;
    Fluctuations fluctuations;
    Effects effects;
    Fault fault;
    Sensor sensor;
    Features features;
    Detection detection;
    Monitoring monitoring;
    Life life;
    Numerics numerics;
    Ensemble ensemble;
    std::vector<RandomInput> random;  // in the order of the schema
    std::vector<Correlation> correlations;

    // Random input with that key, or nullptr.
    const RandomInput* find_random(const std::string& key) const;
    bool operator==(const Study&) const = default;
};

// Feature of a study: one in Python, or else one of the program; nullptr if there is none.
const features::Feature* find_feature(const Study& study, std::string_view name);
// True if any feature compares a gearbox with its baseline record.
bool compares_records(const Study& study);
// True if that property of an assembly (features.baseline_redraws) is drawn again for the baseline.
bool redraws(const Study& study, std::string_view property);

struct StudyReading {
    std::optional<Study> study;  // empty if there are problems
    Problems problems;           // sorted
    Problems notices = {};       // accepted statements that should be written in another way
};

// Reads a study file. Each override is "section.key=value" with a TOML value (a bare word is a
// string) and replaces the value in the file. An override of section.key also removes the key's
// distribution in [random], so that all gearboxes have the given value. An override of
// random.section.key leaves the nominal value in its section; given together with one of
// section.key, in any order, it takes precedence. Invalid input of any kind is reported in
// `problems`, never by an exception.
StudyReading read_study(const std::string& path, const std::vector<std::string>& overrides = {});

// Python files that a study names are run to find their features, as read_study() does, only if the
// user has written the study. Studies stored in results name the features instead and are read with
// files refused, so that reading results runs nobody's code.
enum class PythonFiles { refused, run };

// Reads a study from text; `name` stands for the file in messages.
StudyReading read_study_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides = {},
                             PythonFiles python_files = PythonFiles::refused);

// Complete study as TOML with all defaults. It reads back to the same study, bit for bit.
std::string resolved_text(const Study& study);

// Checks of the numerics of a study that was not read from a file.

// Problems of the study's numerics that reading would report if the keys of [numerics] named in
// `keys` were given with their present values.
Problems numerics_problems(const Study& study, std::span<const std::string_view> keys);
// "precision=single": an assignment of a key of [numerics] as a study file has it, but without
// quotation marks.
std::string numerics_text(const Numerics& numerics, std::string_view key);

}  // namespace gearpod::mc
