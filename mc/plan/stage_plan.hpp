// Neighbouring stages next to the gearboxes of a study: their plans, the shafts that couple them,
// and the conditions under which they can be computed.
#pragma once

#include <memory>
#include <vector>

#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Studies of the neighbouring stages, with the speed of their common shafts and the sensor of the
// study. Only their vibration is used: they have no records and one feature. Throws SceneError.
std::vector<Study> stage_studies(const Study& study);
// Whole plans of the stages of a study, in its order, and the stages next to that gearbox of the
// study. Throw SceneError.
std::vector<Scene> stage_scenes(const Study& study);
std::vector<StagePlan> make_stages(const Study& study, const GearboxPlan& gearbox,
                                   const std::shared_ptr<const std::vector<Scene>>& scenes);

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

// Throws SceneError unless the steps of every stage suffice next to the slowest gearbox, and
// coupled stages can be integrated together: all by the central difference method in double
// precision with steps that are stable with the shafts, under steady loads of which every shaft
// bears a part.
void check_stages(const Study& study, const Scene& scene);

// Statements of stages that have no effect, as notices about the study named `file`.
Problems stage_notices(const Study& study, const std::string& file);

}  // namespace gearpod::mc
