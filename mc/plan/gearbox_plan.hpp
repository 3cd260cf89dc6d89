// Plan of the gearboxes of a study: members, bodies, stiffness, fault, tooth errors,
// variable excitation and neighbouring stages. Turns the inputs of one gearbox into those of its
// dynamic model.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gears/tooth_deviations.hpp"
#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "mc/plan/drivetrain.hpp"
#include "mc/plan/scene_stiffness.hpp"
#include "mc/study/study.hpp"
#include "signals/noise/bearing_impulses.hpp"

namespace gearpod::mc {

struct GearboxPlan;
struct TilePlan;

// Dynamic model of a gearbox at rest: degrees of freedom, masses, springs and dampers. Also defined
// for planetary gearboxes without teeth, which have vibration modes only.
struct BodyModel {
    explicit BodyModel(const Study& study);

    // Inputs of one gearbox; speed and load are left at zero (Drivetrain::set).
    dynamics::GearboxInputs inputs(const InstanceInputs& instance) const;

    dynamics::GearboxLayout layout;
    bool has_backlash = false;  // teeth that move by the backlash touch their other flanks
};

// Flanks on one side of a gear's teeth, which meet one mate.
struct ToothSide {
    std::size_t gear = 0;  // index in lockstep::ToothErrors::gears
    int first_tooth = 0;   // tooth that this side counts as 0
    // Sense in which teeth are numbered in order of engagement: -1 against that of rotation.
    int direction = 1;
    double working_angle_rad = 0.0;
    // Mesh periods from contact at the pitch point to the middle of the engagement, and duration of
    // the engagement from root to tip, negative if contact moves from tip to root.
    double middle = 0.0, outwards = 0.0;
    std::vector<double> measured_m;  // index deviations of its teeth; empty: random
};

// Gear with one working side, or planet with two.
struct ToothedBody {
    Member member;
    int teeth = 0;
    gears::DeviationScales grade_5;  // of ISO 1328; all 0 without a quality
    std::vector<ToothSide> sides;
};

// Individual errors of the teeth: what their random numbers scale.
struct ToothErrorModel {
    std::vector<lockstep::PairTeeth> pairs;
    std::vector<ToothedBody> bodies;  // in the order of lockstep::ToothErrors::gears
};

// Components of the speed's fluctuation that any gearbox has.
struct SpeedFluctuation {
    bool sine = false, noise = false;
};
// Variable excitation; at least one part is there.
struct ExcitationModel {
    bool torque_noise = false;
    std::optional<SpeedFluctuation> speed;
    bool gravity = false;

    bool random() const { return torque_noise || (speed && speed->noise); }
};

// Elastic shaft that couples a neighbouring stage with a gearbox. [0] is its end at that gearbox,
// [1] at the stage.
struct StageShaft {
    double stiffness_N_m_rad = 0.0, damping_ratio = 0.0;
    // It bears opposite external torques at its ends, so that the sense of the stage follows from
    // its torque.
    lockstep::ShaftEnd end[2];
    // True if the study of the stage lets the other side drive, so that the shaft would bear
    // torques of the same sense at both ends. The stage then is the mirror image of its study:
    // everything turns the other way, under the same forces.
    bool mirrored = false;
    // Frequency at which the gearboxes at both ends would turn against each other as rigid bodies,
    // Hz, and the damping for the ratio of that motion.
    double frequency_Hz = 0.0, damping_N_m_s_rad = 0.0;
};

// Neighbouring stage, whose vibration reaches the sensor.
struct StagePlan {
    std::string name;
    double gain = 1.0;  // factor on the vibration at its sensor
    SourceRole role = SourceRole::background;
    // Members at which the common shaft ends: at the other gearbox, and in the stage.
    Member member[2];
    std::optional<std::size_t> other;  // earlier stage at the other end; empty: the study's gearbox
    std::optional<StageShaft> shaft;   // if it twists; empty: both gearboxes turn steadily
    std::shared_ptr<const GearboxPlan> gearbox;  // of the stage
    std::shared_ptr<const TilePlan> tile;        // of the gearboxes of the stage
};

struct GearboxPlan {
    // Without neighbouring stages. Precondition: has_gears(study). Throws SceneError.
    explicit GearboxPlan(const Study& study);

    // Meshes of the gearbox, each with drivetrain->pairs_per_mesh() gear pairs.
    std::span<const MeshMembers> meshes() const { return meshes_of(kind); }
    const lockstep::PairSet& pairs() const { return stiffness->pairs(); }
    const SceneFault& fault() const { return stiffness->fault(); }
    // Inputs of one gearbox with speed, load and bodies.
    dynamics::GearboxInputs inputs(const InstanceInputs& instance) const;

    GearboxKind kind;
    int planets;             // 0 for a fixed-shaft gearbox
    MemberArray<int> teeth;  // 0: the gearbox has no such member, or it has no teeth
    InstanceInputs nominal;  // inputs of the nominal gearbox
    BodyModel bodies;
    std::shared_ptr<const Drivetrain> drivetrain;
    double mesh_frequency_Hz;  // at the nominal speed, with the sign of its mesh_frequency_rad_s()
    std::shared_ptr<const SceneStiffness> stiffness;
    std::optional<ToothErrorModel> tooth_errors;  // empty: all teeth are equal
    std::optional<ExcitationModel> excitation;    // empty: torque, speed and weight are steady
    std::vector<StagePlan> stages;                // in the order of the study
};

// Impulses of one of the study's bearings in a gearbox with these inputs.
signals::BearingImpulses bearing_impulses(const GearboxPlan& gearbox, const InstanceInputs& inputs,
                                          const Bearing& bearing);

// Gearbox of a study as far as its vibration modes depend on it.

struct ModalPlan {
    BodyModel bodies;
    InstanceInputs nominal;          // inputs of the nominal gearbox
    std::vector<double> mean_pairs;  // mean stiffness of every gear pair, N/m
    // Null without tooth numbers: modes then are those at rest only.
    std::shared_ptr<const Drivetrain> drivetrain;
    Member speed_member;  // whose speed the study gives
    bool coupled;         // true if elastic shafts couple the gearbox to neighbouring stages
};

// The study may lack tooth numbers if its mesh stiffness is constant. Throws SceneError if masses
// or inertias are missing.
ModalPlan make_modal_plan(const Study& study);

// Elastic shafts between a gearbox and its neighbouring stages: ends, torques, natural frequencies
// and run-in.

StageShaft make_shaft(const NeighbourStage& given, const GearboxPlan& other,
                      const GearboxPlan& stage);

// Gearbox at the other end of a stage's shaft: an earlier stage, or the study's.
const GearboxPlan& other_end(const GearboxPlan& gearbox, const StagePlan& stage);

// External torque of a gearbox with these inputs on one of its shafts, N m, positive in the sense
// in which this shaft turns.
double shaft_torque_N_m(const GearboxPlan& gearbox, Member shaft, const InstanceInputs& inputs);

// Natural frequencies of the whole train, all gearboxes that elastic shafts couple, at mean mesh
// stiffness and without rotation of the carriers, Hz, ascending.
std::vector<double> train_frequencies_Hz(const GearboxPlan& gearbox);

// Mesh periods of the run-in with coupled stages: at least that many, and until the motion of the
// gearboxes against each other has decayed to the tolerance.
double coupled_run_in(const GearboxPlan& gearbox, double tolerance, int run_in_meshes);
// Mesh periods of a stage by which its records extend beyond those of the study's gearbox.
inline constexpr int kMarginMeshes = 2;

}  // namespace gearpod::mc
