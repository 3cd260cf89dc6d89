// Stages that elastic shafts couple with the study's gearbox (sensor.stages with a shaft
// stiffness): the data of their common integration.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lockstep/strategies/coupled_stages.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Stage of that number in the study of the scene.
const NeighbourStage& stage_of(const Scene& scene, std::size_t stage);

// External torque of a gearbox with these inputs on one of its shafts, N m, positive in the sense
// in which this shaft turns.
double shaft_torque_N_m(const Scene& gearbox, Member shaft, const InstanceInputs& inputs);
// Inertia of the whole nominal gearbox as that shaft feels it while no spring deflects, kg m^2.
double shaft_inertia_kg_m2(const Scene& gearbox, Member shaft);

// Scene of the gearbox at the other end of a stage's shaft: an earlier stage, or the study's own.
const Scene& other_end(const Scene& scene, std::size_t stage);
// Index of that stage; empty for the study's gearbox.
std::optional<std::size_t> other_stage(const Study& study, std::size_t stage);

// True if the study of a stage lets the other side drive, so that its shaft would bear torques of
// the same sense at both ends. The stage then is the mirror image of its study: everything turns
// the other way, under the same forces.
bool is_mirrored(const Scene& scene, std::size_t stage);

// Both ends of a stage's shaft. It bears opposite external torques there, so that the sense of the
// stage follows from its torque.
std::array<lockstep::ShaftEnd, 2> shaft_ends(const Scene& scene, std::size_t stage);

// Frequency at which the gearboxes at both ends of a stage's shaft would turn against each other as
// rigid bodies, Hz, and the shaft's damping for the stage's damping ratio of that motion, N m
// s/rad.
struct ShaftMode {
    double frequency_Hz = 0.0, damping_N_m_s_rad = 0.0;
};
ShaftMode shaft_mode(const Scene& scene, std::size_t stage);

// Natural frequencies of the whole train, all gearboxes that elastic shafts couple, at mean mesh
// stiffness and without rotation of the carriers, Hz, ascending.
std::vector<double> train_frequencies_Hz(const Scene& scene);

// Mesh periods of the run-in: at least that many, and until the motion of the gearboxes against
// each other has decayed.
double coupled_run_in(const Scene& scene, int run_in_meshes);

// One stage in the common integration, in mesh periods of its own except for the times.
struct StageSpan {
    std::size_t stage = 0;       // in Study::sensor.stages
    double period = 0.0;         // its mesh period, mesh periods of the study's gearbox
    int run_in = 0, meshes = 0;  // before the recorded ones, and recorded
    double start = 0.0;          // of its record, mesh periods of the study's gearbox
    double lead = 0.0;           // by which it begins earlier than the study's gearbox, 0 to 1
    int first_mesh = 0;          // of its record in the pattern of its teeth
};
// Common integration: run-in of the study's gearbox, and its stages. The records of the stages
// begin before that of the study's gearbox and end after it, by kMarginMeshes at least.
struct CoupledSpan {
    int run_in = 0;
    std::vector<StageSpan> stages;
};
inline constexpr int kMarginMeshes = 2;
// Every record has stages at random positions of their teeth and of their carriers. Lanes of a tile
// share them: eight gearboxes with consecutive numbers have the same position in the same record.
CoupledSpan coupled_span(const Scene& scene, int run_in_meshes, const GearboxId& id);

// Shafts in a tile of that many lanes; stage i + 1 of the integration is number i of
// CoupledSpan::stages.
std::vector<lockstep::CouplingShaft> coupling_shafts(const Scene& scene, const CoupledSpan& span,
                                                     std::size_t lanes);

// Gearboxes of neighbouring stages next to those of a study.

// Gearbox of stage number `stage` next to the study's gearbox of a record, with the stage's fault
// if `faulty`. Torque and speed differ from their nominal values by the same factors as here; the
// torque of a coupled stage balances that of its shaft. Next to a nominal torque of 0 it has its
// own torque.
Realization stage_gearbox(const Scene& scene, std::size_t stage, const Realization& record,
                          bool faulty = false);

// Conditions under which neighbouring stages can be computed.

// Throws SceneError unless the steps of every stage suffice next to the slowest gearbox, and
// coupled stages can be integrated together: all by the central difference method in double
// precision with steps that are stable with the shafts, under steady loads of which every shaft
// bears a part.
void check_stages(const Scene& scene);

}  // namespace gearpod::mc
