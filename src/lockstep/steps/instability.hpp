// Diagnosis of gearboxes that do not converge to a periodic orbit: instability of the gearbox
// itself, or of the time step.
#pragma once

#include <vector>

#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

// rotating_frame: the carrier rotates above a critical speed. parametric: the variation of the
// stiffness with the mesh phase makes a motion grow that would be stable at constant stiffness
// (parametric resonance). step: the gearbox is stable, but the explicit method's time step is too
// long. none: none of these.
enum class Instability { none, rotating_frame, parametric, step };

// Stiffness of every pair, averaged over the mesh period, N/m.
std::vector<double> mean_stiffness(const IntegrationPlan& plan);

// True if K - W^2 M_xy is not positive definite (rigid rotation excluded), with every pair at its
// mean stiffness. The springs then no longer constrain the bodies in the rotating frame. Coriolis
// forces can stabilize such a gearbox, but not with any damping (Kelvin, Tait and Chetaev), so it
// counts as unstable. Below that speed, damping makes every motion decay. Always false without
// inertial terms.
bool above_critical_speed(const dynamics::GearboxLayout& layout,
                          const dynamics::GearboxInputs& inputs,
                          const std::vector<double>& mean_stiffness);

// Growth per mesh period of the fastest growing motion: the largest |eigenvalue| (Floquet
// multiplier) of the healthy gearbox's mesh period. It is computed by integrating every unit
// displacement and velocity with the plan's steps. The rigid rotation is removed as in
// lockstep/tile. Infinite if a motion overflows. The plan's meshes must not separate.
double growth_per_mesh(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs);

// Reason why the integration of this gearbox diverged or did not converge. A growth below 1e-5 per
// mesh period counts as none. Separating meshes are not tested for parametric resonance, because
// loss of contact bounds it.
Instability find_instability(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs);

}  // namespace gearpod::lockstep
