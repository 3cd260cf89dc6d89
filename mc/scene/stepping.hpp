// How finely a study's mesh period is sampled and stepped, and by which integrator.
#pragma once

#include <vector>

#include "lockstep/plan/integrator.hpp"
#include "mc/scene/drive.hpp"

namespace gearpod::mc {

inline constexpr int kMostSteps = 1'000'000;  // in a mesh period

// Samples of the sensor and of the encoders in one mesh period. Without inertia there is no sensor
// and both are the encoders'.
struct Sampling {
    int samples = 0;
    int te_samples = 0;  // divides samples
};
// Throws SceneError.
Sampling choose_sampling(const Study& study, double mesh_frequency_Hz);

struct Stepping {
    lockstep::Integrator integrator = lockstep::Integrator::rk4;
    int steps = 1;
    // Steps a mesh period below which the integrator is unstable for some gearbox of a pilot
    // sample, or the sensor's low-pass inaccurate.
    int least = 1;
    // Mesh periods that a disturbance of the nominal gearbox takes to decay by 1/e; infinite
    // without damping.
    double decay_meshes = 0.0;
    // The longest step, mesh periods, at which the integrator is stable with some margin and the
    // sensor's low-pass not yet inaccurate.
    double longest_step = 1.0;
    // Steps a mesh period with which the classical Runge-Kutta method is stable, marched or not.
    double explicit_steps = 0.0;
};
// `stiffest_N_m`: all pairs at their stiffest, the bound for an explicit step. Throws SceneError.
Stepping choose_stepping(const Study& study, const Drive& drive,
                         const dynamics::GearboxLayout& layout,
                         const std::vector<double>& stiffest_N_m);

// Relative change at which an orbit has settled: what the study asks for, or what its precision
// can tell.
double settle_tolerance(const Study& study);

// Mesh periods in which a gearbox must settle.
int choose_max_meshes(const Study& study, double decay_meshes);

// Speed, load and body of one gearbox.
dynamics::GearboxInputs gearbox_inputs(const Study& study, const Drive& drive,
                                       const InstanceInputs& instance);

}  // namespace gearpod::mc
