#include "lockstep/tile/static_lanes.hpp"

#include <algorithm>

#include "dynamics/effects/mesh_law.hpp"
#include "dynamics/gearbox_matrices.hpp"
#include "machine/contracts.hpp"

namespace gearpod::lockstep {
namespace {

// Stiffness without the matrices' centrifugal terms, because inertia is omitted, plus a spring on
// the rigid rotation. The centrifugal force that rotates with the carrier is part of the load and
// remains.
Eigen::MatrixXd constrained_stiffness(const dynamics::GearboxMatrices& m,
                                      const Eigen::VectorXd& turn, double mesh_stiffness_N_m) {
    const double size = std::max(m.stiffness.diagonal().maxCoeff(), mesh_stiffness_N_m);
    return m.stiffness + size / turn.squaredNorm() * turn * turn.transpose();
}

}  // namespace

template <int W>
StaticLanes<W> make_static_lanes(const dynamics::GearboxLayout& layout, dynamics::MeshLaw law,
                                 std::span<const dynamics::GearboxInputs> inputs,
                                 double mesh_stiffness_N_m, int contacts) {
    EXPECTS(inputs.size() == W);
    StaticLanes<W> lanes;
    lanes.degrees = dynamics::degrees_of_freedom(layout);
    lanes.pairs = dynamics::pairs(layout);
    lanes.separating = dynamics::separates(law);
    lanes.contacts = contacts;
    lanes.first.push_back(0);
    for (int pair = 0; pair < lanes.pairs; ++pair) {
        const Eigen::VectorXd row = dynamics::mesh_row(layout, PairId{pair});
        for (int i = 0; i < lanes.degrees; ++i) {
            if (row(i) != 0.0) {
                lanes.motion.push_back(i);
                lanes.weight.push_back(row(i));
            }
        }
        lanes.first.push_back(static_cast<int>(lanes.motion.size()));
    }
    const Eigen::VectorXd turn = dynamics::rigid_rotation(layout);
    const std::vector<double> none(static_cast<std::size_t>(lanes.pairs), 0.0);
    const auto n = static_cast<std::size_t>(lanes.degrees);
    lanes.stiffness.resize(n * (n + 1) / 2 * W);
    lanes.force.resize(n * W);
    for (std::size_t l = 0; l < W; ++l) {
        const auto m = dynamics::assemble(layout, inputs[l], none);
        const Eigen::MatrixXd k = constrained_stiffness(m, turn, mesh_stiffness_N_m);
        std::size_t index = l;
        for (int row = 0; row < lanes.degrees; ++row) {
            lanes.force[static_cast<std::size_t>(row) * W + l] = m.force(row);
            for (int column = 0; column <= row; ++column, index += W) {
                lanes.stiffness[index] = k(row, column);
            }
        }
        lanes.force_size.push_back(m.force.cwiseAbs().maxCoeff());
        lanes.backlash.push_back(dynamics::backlash_m(inputs[l]));
    }
    return lanes;
}

template StaticLanes<1> make_static_lanes<1>(const dynamics::GearboxLayout&, dynamics::MeshLaw,
                                             std::span<const dynamics::GearboxInputs>, double, int);
template StaticLanes<4> make_static_lanes<4>(const dynamics::GearboxLayout&, dynamics::MeshLaw,
                                             std::span<const dynamics::GearboxInputs>, double, int);
template StaticLanes<8> make_static_lanes<8>(const dynamics::GearboxLayout&, dynamics::MeshLaw,
                                             std::span<const dynamics::GearboxInputs>, double, int);

template <int W>
StaticState<W>::StaticState(const StaticLanes<W>& lanes)
    : k(static_cast<std::size_t>(lanes.pairs) * W),
      e(k.size()),
      tooth_k(static_cast<std::size_t>(lanes.contacts) * k.size()),
      tooth_e(tooth_k.size()),
      q(lanes.force.size()),
      unsupported(W),
      contacts_changed(W),
      active_stiffness(k.size()),
      preload(k.size()),
      factor(lanes.stiffness.size()),
      inverse(q.size()),
      right_hand(q.size()) {}

template struct StaticState<1>;
template struct StaticState<4>;
template struct StaticState<8>;

}  // namespace gearpod::lockstep
