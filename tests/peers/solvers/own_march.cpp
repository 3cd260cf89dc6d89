#include "own_march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/thread_clock.hpp"

namespace gearpod::peers {
namespace {

// Kind of state: position, velocity, or x, x', y, y' of the filter.
int kind(int i) {
    return i < kMotions ? 0 : i < kMoving ? 1 : 2 + (i - kMoving) % 4;
}

}  // namespace

OwnMarch::OwnMarch(const Options& options)
    : scene_(study_of(options, {"numerics.integrator=rk4"}).study),
      fine_(study_of(options,
                     {"numerics.integrator=rk4", fmt::format("numerics.steps_per_mesh={}",
                                                             2 * scene_.plan().grid.steps.size())})
                .study),
      boxes_(boxes_of(scene_)),
      tables_(scene_, scene_.plan(), boxes_),
      fine_tables_(fine_, fine_.plan(), boxes_),
      task_{scene_, boxes_, tables_, fine_tables_, {}, 0.0, {}} {
    task_.mesh_period_s = dynamics::mesh_period_s(boxes_.inputs[0]);
    start();
}

double OwnMarch::tile_mesh_s() {
    lockstep::MeshRecord record = lockstep::make_record(scene_.plan(), kGearboxes, false);
    const double began = mc::thread_processor_s();
    (*march_)({}, state_, record);
    const double seconds = mc::thread_processor_s() - began;
    rotation_->remove(state_);
    return seconds;
}

// Integrates from rest to the periodic orbit and records the scales of the states.
void OwnMarch::start() {
    march_ = lockstep::make_mesh_march<kGearboxes>(scene_.plan(), boxes_.inputs);
    rotation_ = std::make_unique<lockstep::RigidRotation>(scene_.plan().layout, boxes_.inputs);
    state_ = lockstep::rest_state(scene_.plan(), boxes_.inputs);
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

double OwnMarch::start_value(int i) const {
    double y[kSensing];
    copy_start(task_, 0, y);
    return y[i];
}

}  // namespace gearpod::peers
