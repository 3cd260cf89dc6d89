// Free rotation of a gearbox as a rigid body. No spring constrains it, so it drifts with rounding
// errors, and it does not affect vibration.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

class RigidRotation {
  public:
    // `inputs` has one gearbox per lane.
    RigidRotation(const dynamics::GearboxLayout& layout,
                  std::span<const dynamics::GearboxInputs> inputs);

    // Removes the rotation from positions and velocities.
    void remove(TileState& state) const;

    // Rotation that the motion of a lane contains, in units of phi = dynamics::rigid_rotation.
    double amount(const machine::AlignedVector& motion, LaneId lane) const;
    void subtract(double amount, LaneId lane, machine::AlignedVector& motion) const;
    // Inertia of the rotation of a lane, phi M phi, kg.
    double inertia_kg(LaneId lane) const { return inertia_kg_[lane]; }
    // phi at a degree of freedom.
    double at(int degree) const { return turn_(degree); }

  private:
    void remove(machine::AlignedVector& motion) const;

    Eigen::VectorXd turn_;
    // per lane: phi M / phi M phi, projects a motion onto the rotation
    std::vector<Eigen::VectorXd> weight_;
    std::vector<double> inertia_kg_;
};

// State with zero displacement and velocity, and the sensor's filter at rest.
TileState zero_state(std::size_t degrees, int channels, std::size_t lanes);

// Static equilibrium under the load at phase 0, with the sensor's filter at rest.
TileState equilibrium_state(const IntegrationPlan& plan,
                            std::span<const dynamics::GearboxInputs> inputs);

}  // namespace gearpod::lockstep
