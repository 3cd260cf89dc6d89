// Parameters of W fixed-shaft gearboxes, structure of arrays, as the lockstep kernels read them.
#pragma once

#include <span>

#include "dynamics/fixed_shaft.hpp"

namespace gearpod::dynamics {

template <int W>
struct alignas(64) FixedShaftLanes {
    // [motion][lane].
    double inverse_mass[fixed_shaft_motions][W];
    double force[fixed_shaft_motions][W];
    // [pinion, gear][lane]; the couplings' over R_b^2.
    double bearing_stiffness[fixed_shaft_gear_count][W];
    double bearing_damping[fixed_shaft_gear_count][W];
    double coupling_stiffness[fixed_shaft_gear_count][W];
    double coupling_damping[fixed_shaft_gear_count][W];
    double mesh_damping_factor[W];  // times the shape of the stiffness
    double mesh_period[W];          // s
    double backlash[W];             // 2b of the mesh, m
    int sensor;                     // FixedShaftGear
};

// `inputs` holds W gearboxes.
template <int W>
FixedShaftLanes<W> make_lanes(const FixedShaftLayout& layout,
                              std::span<const FixedShaftInputs> inputs);

extern template FixedShaftLanes<1> make_lanes<1>(const FixedShaftLayout&,
                                                 std::span<const FixedShaftInputs>);
extern template FixedShaftLanes<4> make_lanes<4>(const FixedShaftLayout&,
                                                 std::span<const FixedShaftInputs>);
extern template FixedShaftLanes<8> make_lanes<8>(const FixedShaftLayout&,
                                                 std::span<const FixedShaftInputs>);

}  // namespace gearpod::dynamics
