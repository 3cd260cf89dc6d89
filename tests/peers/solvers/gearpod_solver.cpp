#include "gearpod_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/clocks.hpp"

namespace gearpod::peers {
namespace {

// Kind of state: position, velocity, or x, x', y, y' of the filter.
int kind(int i) {
    return i < kMotions ? 0 : i < kMotionStates ? 1 : 2 + (i - kMotionStates) % 4;
}

}  // namespace

GearpodSolver::GearpodSolver(const Options& options)
    : study_(study_of(options, {"numerics.integrator=rk4"}).study),
      scene_(study_),
      fine_(study_of(options, {"numerics.integrator=rk4",
                               fmt::format("numerics.steps_per_mesh={}",
                                           2 * scene_.solve().integration().grid.steps.size())})
                .study),
      gearboxes_(inputs_of_gearboxes(scene_)),
      tables_(scene_, scene_.solve().integration(), gearboxes_),
      fine_tables_(fine_, fine_.solve().integration(), gearboxes_),
      task_{scene_, gearboxes_, tables_, fine_tables_, {}, 0.0, {}} {
    task_.mesh_period_s = dynamics::mesh_period_s(gearboxes_.inputs[0]);
    start();
}

double GearpodSolver::tile_mesh_s() {
    lockstep::MeshRecord record =
        lockstep::make_record(scene_.solve().integration(), kGearboxes, false);
    const double began = mc::thread_processor_s();
    (*mesh_integrator_)({}, state_, record);
    const double seconds = mc::thread_processor_s() - began;
    rotation_->remove(state_);
    return seconds;
}

// Integrates from rest to the periodic orbit and records the scales of the states.
void GearpodSolver::start() {
    mesh_integrator_ =
        lockstep::make_mesh_integrator<kGearboxes>(scene_.solve().integration(), gearboxes_.inputs);
    rotation_ = std::make_unique<lockstep::RigidRotation>(scene_.solve().integration().layout,
                                                          gearboxes_.inputs);
    state_ = lockstep::equilibrium_state(scene_.solve().integration(), gearboxes_.inputs);
    for (int k = 0; k < 5; ++k) {
        tile_mesh_s();
    }
    task_.start = state_;
    double size[6] = {};
    for (int i = 0; i < kSensing; ++i) {
        size[kind(i)] = std::max(size[kind(i)], std::abs(start_value(i)));
    }
    for (int i = 0; i < kSensing; ++i) {
        task_.scale[i] = size[kind(i)];
    }
}

double GearpodSolver::start_value(int i) const {
    double y[kSensing];
    copy_start(task_, 0, y);
    return y[i];
}

}  // namespace gearpod::peers
