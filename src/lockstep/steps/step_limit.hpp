// Stability limit of the time step for a gearbox, and the part of the gearbox that determines it.
#pragma once

#include <string>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integrator.hpp"

namespace gearpod::lockstep {

// A of (q, v)' = A (q, v) + ..., first q, then v.
Eigen::MatrixXd state_matrix(const dynamics::GearboxMatrices& matrices);

struct StepLimit {
    double step_s = 0.0;             // longest step for which no decaying mode grows
    double slowest_decay_1_s = 0.0;  // smallest decay rate of the modes; 0 without damping
};

// Limit from the eigenvalues of M q'' + (C + G) q' + (K + K_c) q = 0: |R(h lambda)| <= 1 for every
// eigenvalue that does not grow by itself. R(z) is the integrator's growth
// (integrators/method.hpp), which it must have. The rigid rotation is excluded, and with it all
// modes slower than 1e-4 of the undamped rates.
StepLimit runge_kutta_limit(const dynamics::GearboxMatrices& matrices,
                            Integrator integrator = Integrator::rk4);

// Longest step (s) of central differences evaluated at midpoints: M - h C - h^2/4 (K + K_c) must be
// positive definite. At the limit, a motion changes sign at every step without decaying. It has q =
// 0 at the steps' ends and h/2 q' at their midpoints, where the velocity from the previous step's
// acceleration is doubled. For one mode: omega h = 2 (sqrt(1 + 4 zeta^2) - 2 zeta). Gyroscopic
// forces do no work on it and have no influence.
double central_difference_limit(const dynamics::GearboxMatrices& matrices);

// Longest step (s) for which an explicit integrator lets no decaying mode grow.
double longest_stable_step(const dynamics::GearboxMatrices& matrices, Integrator integrator);

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

// rk4 if it is stable with at most kMostExplicitSteps steps per mesh period, otherwise sdirk3.
Integrator choose_integrator(double stable_steps_per_mesh);

// Steps per mesh period for an implicit integrator. Errors of the sensor signal and of the motion
// then stay within 0.1 % of their largest values. It takes a fixed number of steps per period of
// the sensor's band edge and of the fastest oscillating mode (damping ratio below one half). Modes
// above five times the band edge count as lying there; their response at the sensor is below 1/600.
double implicit_steps(Integrator integrator, const dynamics::GearboxMatrices& matrices,
                      double mesh_period_s, double low_pass_rad_s);

}  // namespace gearpod::lockstep
