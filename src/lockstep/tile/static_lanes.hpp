// Static equilibrium of W gearboxes in lockstep: K q = f with the stiffness of all meshes at one
// phase, or the equilibrium of meshes that separate.
#pragma once

#include <span>
#include <vector>

#include "dynamics/gearbox.hpp"
#include "machine/lanes.hpp"

namespace gearpod::lockstep {

// Data of W realizations that do not depend on the phase.
template <int W>
struct StaticLanes {
    int degrees = 0;
    int pairs = 0;
    // Deflection of pair p: the sum of weight[i] q[motion[i]] over first[p] <= i < first[p + 1].
    std::vector<int> first, motion;
    std::vector<double> weight;
    // Stiffness without the meshes, lower triangle [row (row + 1) / 2 + column][lane]. A spring on
    // phi . q constrains the free rigid rotation phi; a balanced load leaves it at zero.
    machine::AlignedVector stiffness;
    machine::AlignedVector force;       // [degree of freedom][lane], N
    machine::AlignedVector force_size;  // [lane]: largest absolute entry of the force
    machine::AlignedVector backlash;    // [lane], m
    bool separating = false;
    int contacts = 0;  // springs per pair under unilateral contact
};

template <int W>
StaticLanes<W> make_static_lanes(const dynamics::GearboxLayout& layout, dynamics::MeshLaw law,
                                 std::span<const dynamics::GearboxInputs> inputs,
                                 double mesh_stiffness_N_m, int contacts);

// Meshes at one phase, the solution, and workspace.
template <int W>
struct StaticState {
    explicit StaticState(const StaticLanes<W>& lanes);
    machine::AlignedVector k, e;  // [pair][lane], N/m and m
    // Springs under unilateral contact, [contact][pair][lane], N/m and m.
    machine::AlignedVector tooth_k, tooth_e;
    machine::AlignedVector q;  // [degree of freedom][lane], m
    // [lane], 1 or 0: a load meets no stiffness; the last iteration changed a contact.
    machine::AlignedVector unsupported, contacts_changed;

    machine::AlignedVector active_stiffness, preload;    // [pair][lane], of the current contacts
    machine::AlignedVector factor, inverse, right_hand;  // of the equations
};

// Solves for state.q from state.k and state.e. A body without stiffness and without load stays at
// zero. A load that meets no stiffness marks its lane `unsupported`, and its q is then invalid.
// Lanes do not affect each other.
template <int W>
void solve_static(const StaticLanes<W>& lanes, StaticState<W>& state);

}  // namespace gearpod::lockstep
