// The sensor and encoders of a tile that is marched mesh by mesh, and the sensor's gain.
#pragma once

#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

bool has_gain(std::span<const InstanceInputs> inputs);
// The sensor's gain, into what was recorded of each lane's motion.
void amplify(std::span<const InstanceInputs> inputs, machine::AlignedVector& acceleration);

std::vector<double> path_exponents(std::span<const InstanceInputs> inputs);

// Gives the tile its tones and what the sensors hear, tile.heard, mesh by mesh.
class Ears {
  public:
    // `signal_meshes` as in TileWishes. `path` and the tile must outlive it.
    Ears(const Scene& scene, const signals::PathGrid& path, std::span<const GearboxId> ids,
         int signal_meshes, GearboxTile& tile);

    // Recorded mesh k, as lockstep::TileSettings::hear. Where fewer are recorded than the signal
    // has, it repeats them.
    void operator()(int k, const lockstep::MeshRecord& record);

    double spent_s() const { return spent_s_; }

  private:
    GearboxTile& tile_;
    const bool amplified_;
    const int heard_meshes_, recorded_meshes_;
    machine::AlignedVector louder_;
    double spent_s_ = 0.0;
};

}  // namespace gearpod::mc
