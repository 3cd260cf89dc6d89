// GEARPOD_DOUBLE_MARCHES(linear_rk4_double, RungeKutta4, dynamics::LinearMesh) defines the explicit
// kernels of one method and mesh law in double precision, GEARPOD_SINGLE_MARCHES those in single:
// every gearbox model, all widths. One file each, so that none compiles for long.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/kernels/explicit_march.hpp"

#define GEARPOD_MARCH(DEFINE, NAME, METHOD, LANES, ...)                                        \
    DEFINE(NAME,                                                                               \
           (const MarchPlan& plan, const LANES& lanes, const machine::AlignedVector& filter,   \
            const std::vector<PairOverride>& overrides, TileState& state, MeshRecord& record), \
           (plan, lanes, filter, overrides, state, record),                                    \
           march<METHOD, __VA_ARGS__>(plan, lanes, filter, overrides, state, record))

// Outside a macro's arguments their types' commas would count.
#define GEARPOD_PLANETARY_LANES(W, REAL) dynamics::PlanetaryLanes<W, REAL>
#define GEARPOD_FIXED_SHAFT_LANES(W, REAL) dynamics::FixedShaftLanes<W, REAL>

#define GEARPOD_MARCHES_OF_WIDTH(DEFINE, NAME, METHOD, MESH, W, REAL)                           \
    GEARPOD_MARCH(DEFINE, NAME##_translational_inertial_##W, METHOD,                            \
                  GEARPOD_PLANETARY_LANES(W, REAL),                                             \
                  dynamics::TranslationalMotion<dynamics::WithInertialTerms, MESH, W, REAL>)    \
    GEARPOD_MARCH(DEFINE, NAME##_translational_##W, METHOD, GEARPOD_PLANETARY_LANES(W, REAL),   \
                  dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, MESH, W, REAL>) \
    GEARPOD_MARCH(DEFINE, NAME##_torsional_##W, METHOD, GEARPOD_PLANETARY_LANES(W, REAL),       \
                  dynamics::TorsionalMotion<MESH, W, REAL>)                                     \
    GEARPOD_MARCH(DEFINE, NAME##_fixed_shaft_##W, METHOD, GEARPOD_FIXED_SHAFT_LANES(W, REAL),   \
                  dynamics::FixedShaftMotions<MESH, W, REAL>)

#define GEARPOD_DOUBLE_MARCHES(NAME, METHOD, MESH)                                 \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_KERNEL, NAME, METHOD, MESH, 8, double)        \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, NAME, METHOD, MESH, 4, double) \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, NAME, METHOD, MESH, 1, double)

#define GEARPOD_SINGLE_MARCHES(NAME, METHOD, MESH)                                \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_KERNEL, NAME, METHOD, MESH, 16, float)       \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, NAME, METHOD, MESH, 8, float) \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, NAME, METHOD, MESH, 4, float) \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, NAME, METHOD, MESH, 1, float)
