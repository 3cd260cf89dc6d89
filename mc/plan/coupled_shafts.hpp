// Elastic shafts between a gearbox and its neighbouring stages: ends, torques, natural frequencies
// and run-in.
#pragma once

#include <vector>

#include "mc/plan/gearbox_plan.hpp"

namespace gearpod::mc {

// Shaft of a stage between these gearboxes.
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
