// The sensor and encoders of a tile that is marched mesh by mesh, and the sensor's gain.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockstep/plan/march.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/sensor/heard_span.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const InstanceInputs> inputs);
// The sensor's gain, into what was recorded of each lane's motion.
void amplify(std::span<const InstanceInputs> inputs, machine::AlignedVector& acceleration);

std::vector<double> path_exponents(std::span<const InstanceInputs> inputs);

class Ears {
  public:
    // Of the sensor's samples the first `kept_meshes` are kept; -1: all. `inputs`, one a lane, must
    // outlive it, and `path` the march.
    Ears(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
         std::span<const InstanceInputs> inputs, int kept_meshes);

    // Recorded mesh k, as lockstep::TileSettings::hear. Where fewer are recorded than the signal
    // has, it repeats them.
    void operator()(int k, const lockstep::MeshRecord& record);

    std::unique_ptr<signals::HeardSpan> take_heard() { return std::move(heard_); }
    double spent_s() const { return spent_s_; }

  private:
    const std::span<const InstanceInputs> inputs_;
    const bool amplified_;
    const int heard_meshes_, recorded_meshes_;
    std::unique_ptr<signals::HeardSpan> heard_;
    machine::AlignedVector louder_;
    double spent_s_ = 0.0;
};

}  // namespace gearpod::mc
