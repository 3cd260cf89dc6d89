// GEARPOD_MARCHES(linear, dynamics::LinearMesh) defines the explicit kernels of one mesh law: every
// gearbox model, all widths. One file a law, so that none compiles for long.
#pragma once

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/explicit_march.hpp"
#include "lockstep/runge_kutta.hpp"

#define GEARPOD_MARCH(DEFINE, NAME, LANES, ...)                                                \
    DEFINE(NAME,                                                                               \
           (const MarchPlan& plan, const LANES& lanes, const machine::AlignedVector& filter,   \
            const std::vector<PairOverride>& overrides, TileState& state, MeshRecord& record), \
           (plan, lanes, filter, overrides, state, record),                                    \
           march<RungeKutta4, __VA_ARGS__>(plan, lanes, filter, overrides, state, record))

#define GEARPOD_MARCHES_OF_WIDTH(DEFINE, LAW, MESH, W)                                    \
    GEARPOD_MARCH(DEFINE, LAW##_translational_inertial_##W, dynamics::PlanetaryLanes<W>,  \
                  dynamics::TranslationalMotion<dynamics::WithInertialTerms, MESH, W>)    \
    GEARPOD_MARCH(DEFINE, LAW##_translational_##W, dynamics::PlanetaryLanes<W>,           \
                  dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, MESH, W>) \
    GEARPOD_MARCH(DEFINE, LAW##_torsional_##W, dynamics::PlanetaryLanes<W>,               \
                  dynamics::TorsionalMotion<MESH, W>)                                     \
    GEARPOD_MARCH(DEFINE, LAW##_fixed_shaft_##W, dynamics::FixedShaftLanes<W>,            \
                  dynamics::FixedShaftMotions<MESH, W>)

#define GEARPOD_MARCHES(LAW, MESH)                                \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_KERNEL, LAW, MESH, 8)        \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 4) \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 1)
