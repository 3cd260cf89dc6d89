// Parameters of W fixed-shaft gearboxes for the lockstep kernels, as a structure of arrays.
#pragma once

#include <span>

#include "dynamics/fixed_shaft.hpp"
#include "machine/lanes.hpp"

namespace gearpod::dynamics {

template <int W, class RealType = double>
struct alignas(64) FixedShaftLanes {
    using Real = RealType;
    // [motion][lane].
    Real inverse_mass[fixed_shaft_motions][W];
    Real force[fixed_shaft_motions][W];
    // [pinion, gear][lane]; those of the couplings are divided by R_b^2.
    Real bearing_stiffness[fixed_shaft_gear_count][W];
    Real bearing_damping[fixed_shaft_gear_count][W];
    Real coupling_stiffness[fixed_shaft_gear_count][W];
    Real coupling_damping[fixed_shaft_gear_count][W];
    DampingLanes<W, Real> mesh_damping;
    Real mesh_period[W];  // s
    Real backlash[W];     // 2b of the mesh, m
    int sensor;           // FixedShaftGear
};

// `inputs` holds W gearboxes.
template <int W, class Real = double>
FixedShaftLanes<W, Real> make_lanes(const FixedShaftLayout& layout,
                                    std::span<const FixedShaftInputs> inputs);

}  // namespace gearpod::dynamics
