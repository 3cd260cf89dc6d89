// Stiffness of all pairs at the stage nodes of a phase grid: one contiguous load per pair and node.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "lockstep/phase_grid.hpp"
#include "stiffness/pair_stiffness.hpp"

namespace gearpod::lockstep {

// A planetary train's 2N pairs: sp1..spN, rp1..rpN. Pair i's tooth pairs start engaging at the
// phases start[i] + integer, in mesh periods since sp1 was at its pitch point.
struct PairSet {
    const stiffness::PairStiffness* sun_planet = nullptr;
    const stiffness::PairStiffness* ring_planet = nullptr;
    std::vector<double> start;  // in [0, 1)
    // The planets turn the other way past the carrier (the sun is held, or the ring drives a
    // standing carrier): contact runs the same line of action from its end to its start.
    bool reversed = false;

    int pairs() const { return static_cast<int>(start.size()); }
    const stiffness::PairStiffness& curve(int pair) const {
        return 2 * pair < pairs() ? *sun_planet : *ring_planet;
    }

    // Stiffness of a tooth pair, healthy or faulty, at positions tau (ascending) since it engaged.
    template <class Curve>
    void tooth_pair(const Curve& tooth, double contact_ratio, std::span<const double> tau,
                    std::span<double> stiffness) const;
    // All tooth pairs of a healthy pair at a phase (mesh periods since sp1 was at its pitch point).
    double mesh(int pair, double phase) const;
};

template <class Curve>
void PairSet::tooth_pair(const Curve& tooth, double contact_ratio, std::span<const double> tau,
                         std::span<double> stiffness) const {
    if (!reversed) {
        tooth.tooth_pair(tau, stiffness);
        return;
    }
    std::vector<double> mirrored(tau.rbegin(), tau.rend());
    for (double& position : mirrored) {
        position = contact_ratio - position;
    }
    tooth.tooth_pair(mirrored, stiffness);
    std::reverse(stiffness.begin(), stiffness.end());
}

// The part of a phase within its mesh period, in [0, 1).
double phase_in_period(double phase);

// Phases in [0, 1) at which the number of tooth pairs in contact jumps, of all pairs.
std::vector<double> contact_transitions(const PairSet& pairs);

// Stiffness and damping shape (dynamics::MeshDamping), [step][stage node][pair].
struct StiffnessNodes {
    int pairs = 0;
    std::vector<double> stiffness;      // N/m
    std::vector<double> damping_shape;  // see effects/mesh_damping.hpp
};

StiffnessNodes tabulate(const PairSet& pairs, const PhaseGrid& grid, dynamics::MeshDamping damping);

// Position of one tooth pair at the stage nodes of every step of mesh `mesh` (an integer count of
// mesh periods), in mesh periods since it began to engage at phase `start` (not reduced), clamped
// to [0, contact_ratio], and the range of steps during which it is in contact.
struct ToothPositions {
    std::vector<double> tau;  // [step][stage node]
    int first_step = 0;
    int last_step = 0;  // one past the last
};
ToothPositions tooth_positions(const PhaseGrid& grid, double mesh, double start,
                               double contact_ratio);

}  // namespace gearpod::lockstep
