// Numbers of samples and steps per mesh period of a study, and its integrator.
#pragma once

#include "lockstep/plan/integrator.hpp"
#include "lockstep/plan/mode_inertia.hpp"
#include "mc/plan/gearbox_plan.hpp"
#include "mc/plan/sampling.hpp"

namespace gearpod::mc {

inline constexpr int kMostSteps = 1'000'000;  // per mesh period

// Number of samples per mesh period of the sensor and of the encoders. A quasi-static gearbox has
// no sensor, and both are the encoders'.
struct Sampling {
    int samples = 0;
    int te_samples = 0;  // divides samples
};
// Throws SceneError.
Sampling choose_sampling(const Study& study, double mesh_frequency_Hz);

struct Stepping {
    lockstep::Integrator integrator = lockstep::kUsualExplicit;
    int steps = 1;
    // Smallest number of steps per mesh period. With fewer, the integrator is unstable for some
    // gearbox of the pilot sample or the sensor's low-pass is inaccurate.
    int least = 1;
    // Number of mesh periods in which a disturbance of the nominal gearbox decays to 1/e.
    double decay_meshes = 0.0;
    // Longest step, in mesh periods, at which the integrator is stable with a margin and the
    // sensor's low-pass still accurate.
    double longest_step = 1.0;
    // Number of steps per mesh period with which lockstep::kUsualExplicit is stable, used or not.
    double explicit_steps = 0.0;
};
// `mode_inertia`: additional inertia of the nominal gearbox. Throws SceneError.
Stepping choose_stepping(const Study& study, const Sampler& sampler, const GearboxPlan& gearbox,
                         const lockstep::ModeInertia& mode_inertia);

}  // namespace gearpod::mc
