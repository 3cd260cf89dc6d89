// Stability limit of the time step for a gearbox, and the part of the gearbox that determines it.
#pragma once

#include <string>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/integrator.hpp"

namespace gearpod::lockstep {

// A of (q, v)' = A (q, v) + ..., first q, then v.
Eigen::MatrixXd state_matrix(const dynamics::GearboxMatrices& matrices);

// Longest step (s) with which an explicit integrator lets no decaying mode grow: its own
// stable_step(), or |R(h lambda)| <= 1 for every eigenvalue lambda of M q'' + (C + G) q' + (K +
// K_c) q = 0 that does not grow by itself. R(z) is the integrator's growth(z)
// (integrators/method.hpp). The rigid rotation is excluded, and with it all modes slower than 1e-4
// of the undamped rates.
double longest_stable_step(const dynamics::GearboxMatrices& matrices, Integrator integrator);

// Smallest decay rate (1/s) of those modes without the two that are most like
// dynamics::rigid_rotation(): inertial terms make it grow and decay faster than that limit. 0
// without damping.
double slowest_decay_1_s(const dynamics::GearboxMatrices& matrices,
                         const Eigen::VectorXd& rigid_rotation);

// Cause of a gearbox's stiffness: its fastest mode, and the spring or damper that dominates it.
struct StiffPart {
    double rate_1_s = 0.0;  // |lambda| of the mode
    std::string part;       // as in "the damper of the motor coupling"
    std::string motion;     // degree of freedom with most of the mode's inertia
};
StiffPart stiffest_part(const dynamics::GearboxLayout& layout,
                        const dynamics::GearboxInputs& inputs,
                        const std::vector<double>& pair_stiffness_N_m);

// Steps per mesh period above which an explicit method costs more than an implicit one.
inline constexpr double kMostExplicitSteps = 20e3;

// kUsualExplicit if it is stable with at most kMostExplicitSteps steps per mesh period, otherwise
// kUsualImplicit.
Integrator choose_integrator(double stable_steps_per_mesh);

// Steps per mesh period for an implicit integrator. Errors of the sensor signal and of the motion
// then stay within 0.1 % of their largest values. It takes a fixed number of steps per period of
// the sensor's band edge and of the fastest oscillating mode (damping ratio below one half). Modes
// above five times the band edge count as lying there; their response at the sensor is below 1/600.
double implicit_steps(Integrator integrator, const dynamics::GearboxMatrices& matrices,
                      double mesh_period_s, double low_pass_rad_s);

// Diagnosis of gearboxes that do not converge to a periodic orbit: instability of the gearbox
// itself, or of the time step.

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
// lockstep/tile. Infinite if a motion overflows. For meshes that do not separate.
double growth_per_mesh(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs);

// Reason why the integration of this gearbox diverged or did not converge. A growth below 1e-5 per
// mesh period counts as none. Separating meshes are not tested for parametric resonance, because
// loss of contact bounds it.
Instability find_instability(const IntegrationPlan& plan, const dynamics::GearboxInputs& inputs);

}  // namespace gearpod::lockstep
