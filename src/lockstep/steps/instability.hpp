// Why a gearbox does not come to rest on an orbit: its own physics, or the step.
#pragma once

#include <vector>

#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

// turning_frame: the carrier turns above a critical speed. parametric: steady stiffness would be
// stable, its change with the mesh phase makes a motion grow (parametric resonance). step: the
// gearbox is as it should be, but the explicit method's step is too long for it. none: nothing of
// all that.
enum class Instability { none, turning_frame, parametric, step };

// Of every pair over the mesh period, N/m.
std::vector<double> mean_stiffness(const MarchPlan& plan);

// With every pair at its mean stiffness, the springs no longer hold the bodies in the turning
// frame: K - W^2 M_xy is not positive definite, the rigid rotation left aside. Coriolis forces can
// hold such a gearbox, but not once anything damps it (Kelvin, Tait and Chetaev), so it counts as
// unstable. Below that speed damping makes every motion decay. Always false without inertial terms.
bool above_critical_speed(const dynamics::GearboxLayout& layout,
                          const dynamics::GearboxInputs& inputs,
                          const std::vector<double>& mean_stiffness);

// Growth of the fastest growing motion from one mesh period to the next, the rigid rotation removed
// as the march removes it (lockstep/tile): the largest |eigenvalue| (Floquet multiplier) of the
// healthy gearbox's mesh period, from marching every displacement and velocity by itself with the
// plan's steps. Infinite if a motion overflows. The plan's meshes must not separate.
double growth_per_mesh(const MarchPlan& plan, const dynamics::GearboxInputs& inputs);

// Why a march of this gearbox diverged or did not settle. A growth of less than 1e-5 a mesh period
// counts as none. Meshes that separate are not asked for parametric resonance: losing contact
// bounds it.
Instability find_instability(const MarchPlan& plan, const dynamics::GearboxInputs& inputs);

}  // namespace gearpod::lockstep
