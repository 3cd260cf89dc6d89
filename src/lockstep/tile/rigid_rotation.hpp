// The free rotation of a tile's gearboxes as a whole: no spring holds it, so it drifts with every
// rounding and says nothing about vibration.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

class RigidRotation {
  public:
    // `inputs`: one gearbox a lane.
    RigidRotation(const dynamics::GearboxLayout& layout,
                  std::span<const dynamics::GearboxInputs> inputs);

    // Takes it out of positions and velocities.
    void remove(TileState& state) const;

  private:
    void remove(machine::AlignedVector& motion) const;

    Eigen::VectorXd turn_;
    std::vector<Eigen::VectorXd> weight_;  // a lane's phi M / phi M phi: measures it in a motion
};

// Neither displaced nor moving, the sensor's filter at rest.
TileState still_state(std::size_t degrees, int channels, std::size_t lanes);

// Static equilibrium under the load at phase 0, the sensor's filter at rest.
TileState rest_state(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs);

}  // namespace gearpod::lockstep
