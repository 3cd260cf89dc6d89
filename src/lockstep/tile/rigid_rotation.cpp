#include "lockstep/tile/rigid_rotation.hpp"

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/sensor_filter.hpp"

namespace gearpod::lockstep {

RigidRotation::RigidRotation(const dynamics::GearboxLayout& layout,
                             std::span<const dynamics::GearboxInputs> inputs)
    : turn_(dynamics::rigid_rotation(layout)) {
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    for (const dynamics::GearboxInputs& in : inputs) {
        const auto m = dynamics::assemble(layout, in, none);
        const Eigen::VectorXd weighted = m.mass * turn_;
        inertia_kg_.push_back(weighted.dot(turn_));
        weight_.emplace_back(weighted / inertia_kg_.back());
    }
}

double RigidRotation::amount(const machine::AlignedVector& motion, LaneId lane) const {
    double rotation = 0.0;
    for (Eigen::Index d = 0; d < turn_.size(); ++d) {
        rotation += weight_[lane](d) * motion[static_cast<std::size_t>(d) * weight_.size() + lane];
    }
    return rotation;
}

void RigidRotation::subtract(double amount, LaneId lane, machine::AlignedVector& motion) const {
    for (Eigen::Index d = 0; d < turn_.size(); ++d) {
        motion[static_cast<std::size_t>(d) * weight_.size() + lane] -= amount * turn_(d);
    }
}

void RigidRotation::remove(machine::AlignedVector& motion) const {
    for (LaneId l{0}; l < weight_.size(); ++l) {
        subtract(amount(motion, l), l, motion);
    }
}

void RigidRotation::remove(TileState& state) const {
    remove(state.q);
    remove(state.v);
}

TileState zero_state(std::size_t degrees, int channels, std::size_t lanes) {
    TileState state;
    state.q.assign(degrees * lanes, 0.0);
    state.v.assign(degrees * lanes, 0.0);
    state.filter.assign(static_cast<std::size_t>(channels) * kFilterStates * lanes, 0.0);
    return state;
}

TileState equilibrium_state(const IntegrationPlan& plan,
                            std::span<const dynamics::GearboxInputs> inputs) {
    const std::size_t lanes = inputs.size();
    const auto pairs = plan.nodes.stiffness.begin();
    const std::vector<double> stiffness(pairs, pairs + plan.nodes.pairs);
    const auto degrees = static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout));
    TileState state = zero_state(degrees, plan.channels(), lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
        const Eigen::VectorXd q =
            dynamics::static_equilibrium(dynamics::assemble(plan.layout, inputs[l], stiffness));
        for (std::size_t d = 0; d < degrees; ++d) {
            state.q[d * lanes + l] = q(static_cast<Eigen::Index>(d));
        }
    }
    return state;
}

}  // namespace gearpod::lockstep
