// How long a step an integrator stands on a gearbox, and what in the gearbox sets it.
#pragma once

#include <string>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integrator.hpp"

namespace gearpod::lockstep {

// A of (q, v)' = A (q, v) + ..., first q, then v.
Eigen::MatrixXd state_matrix(const dynamics::GearboxMatrices& matrices);

struct StepLimit {
    double step_s = 0.0;             // longest step that lets no decaying mode grow
    double slowest_decay_1_s = 0.0;  // smallest decay rate of the modes; 0 without damping
};

// From the eigenvalues of M q'' + (C + G) q' + (K + K_c) q = 0: |R(h lambda)| <= 1 with
// R(z) the integrator's growth (integrators/method.hpp), which it must have, for every eigenvalue
// that does not grow by itself. The rigid rotation is left out, and with it what creeps at less
// than 1e-4 of the undamped rates.
StepLimit runge_kutta_limit(const dynamics::GearboxMatrices& matrices,
                            Integrator integrator = Integrator::rk4);

// The longest step (s) of central differences on the steps' middles: M - h C - h^2/4 (K + K_c) must
// be positive definite. Just there a motion first swaps its sign at every step without decaying,
// q = 0 at the steps' ends, h/2 q' at their middles, where the velocity carried by the acceleration
// of the step before comes out doubled. One mode: omega h = 2 (sqrt(1 + 4 zeta^2) - 2 zeta). The
// gyroscopic forces do no work on it and do not enter.
double central_difference_limit(const dynamics::GearboxMatrices& matrices);

// The longest step (s) at which an explicit integrator lets no decaying mode grow.
double longest_stable_step(const dynamics::GearboxMatrices& matrices, Integrator integrator);

// What makes a gearbox stiff: its fastest mode, and the spring or damper that drives it.
struct StiffPart {
    double rate_1_s = 0.0;  // |lambda| of the mode
    std::string part;       // as in "the damper of the motor coupling"
    std::string motion;     // the degree of freedom that carries most of the mode's inertia
};
StiffPart stiffest_part(const dynamics::GearboxLayout& layout,
                        const dynamics::GearboxInputs& inputs,
                        const std::vector<double>& pair_stiffness_N_m);

// Steps a mesh period above which the explicit method is not worth its steps.
inline constexpr double kMostExplicitSteps = 20e3;

// rk4 where it is stable with at most that many steps a mesh period, else sdirk3.
Integrator choose_integrator(double stable_steps_per_mesh);

// Steps a mesh period with which an implicit integrator keeps the sensor's signal and the motion
// within 0.1 % of their largest values: so many steps in a period of the sensor's band edge and of
// the fastest mode that rings (damping ratio below one half). Modes beyond five times the band edge
// count as if they were there; they reach the sensor by less than 1/600.
double implicit_steps(Integrator integrator, const dynamics::GearboxMatrices& matrices,
                      double mesh_period_s, double low_pass_rad_s);

}  // namespace gearpod::lockstep
