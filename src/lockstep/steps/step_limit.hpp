// Stability limit of the time step for a gearbox, and the part of the gearbox that determines it.
#pragma once

#include <string>

#include "dynamics/gearbox.hpp"
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

// Smallest decay rate (1/s) of those modes; 0 without damping.
double slowest_decay_1_s(const dynamics::GearboxMatrices& matrices);

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

}  // namespace gearpod::lockstep
