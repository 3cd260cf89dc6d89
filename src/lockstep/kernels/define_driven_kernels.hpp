// GEARPOD_FORCED_MARCHES(linear, dynamics::LinearMesh) defines the kernels of one mesh law that
// march under forces that vary, GEARPOD_PACED_MARCHES those with a speed that fluctuates. One file
// each, so that none compiles for long.
#pragma once

#include "lockstep/driven/paced_runge_kutta.hpp"
#include "lockstep/integrators/runge_kutta.hpp"
#include "lockstep/integrators/sdirk3.hpp"
#include "lockstep/kernels/driven_kernels.hpp"

#define GEARPOD_DRIVEN_MARCH(DEFINE, NAME, METHOD, LANES, ...)                                 \
    DEFINE(NAME,                                                                               \
           (const MarchPlan& plan, const LANES& lanes, const machine::AlignedVector& filter,   \
            const std::vector<PairOverride>& overrides, TileState& state, MeshRecord& record), \
           (plan, lanes, filter, overrides, state, record),                                    \
           march<METHOD, __VA_ARGS__>(plan, lanes, filter, overrides, state, record))

#define GEARPOD_FORCED_OF_WIDTH(DEFINE, LAW, MESH, W)                                              \
    GEARPOD_DRIVEN_MARCH(                                                                          \
        DEFINE, LAW##_forced_translational_inertial_##W, RungeKutta4, DrivenPlanetaryLanes<W>,     \
        Forced<dynamics::TranslationalMotion<dynamics::WithInertialTerms, MESH, W>>)               \
    GEARPOD_DRIVEN_MARCH(                                                                          \
        DEFINE, LAW##_forced_translational_##W, RungeKutta4, DrivenPlanetaryLanes<W>,              \
        Forced<dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, MESH, W>>)            \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_forced_torsional_##W, RungeKutta4, DrivenPlanetaryLanes<W>, \
                         Forced<dynamics::TorsionalMotion<MESH, W>>)                               \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_forced_fixed_shaft_##W, RungeKutta4,                        \
                         DrivenFixedShaftLanes<W>, Forced<dynamics::FixedShaftMotions<MESH, W>>)   \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_forced_sdirk3_##W, Sdirk3, DrivenImplicitLanes<W>,          \
                         ForcedMatrixMotion<MatrixMotion<MESH, W>>)

#define GEARPOD_PACED_OF_WIDTH(DEFINE, LAW, MESH, W)                                       \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_paced_translational_inertial_##W, PacedRungeKutta4, \
                         DrivenPlanetaryLanes<W>, PacedTranslational<true, MESH, W>)       \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_paced_translational_##W, PacedRungeKutta4,          \
                         DrivenPlanetaryLanes<W>, PacedTranslational<false, MESH, W>)      \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_paced_torsional_##W, PacedRungeKutta4,              \
                         DrivenPlanetaryLanes<W>, PacedTorsional<MESH, W>)                 \
    GEARPOD_DRIVEN_MARCH(DEFINE, LAW##_paced_fixed_shaft_##W, PacedRungeKutta4,            \
                         DrivenFixedShaftLanes<W>, PacedFixedShaft<MESH, W>)

#define GEARPOD_FORCED_MARCHES(LAW, MESH)                        \
    GEARPOD_FORCED_OF_WIDTH(GEARPOD_KERNEL, LAW, MESH, 8)        \
    GEARPOD_FORCED_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 4) \
    GEARPOD_FORCED_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 1)

#define GEARPOD_PACED_MARCHES(LAW, MESH)                        \
    GEARPOD_PACED_OF_WIDTH(GEARPOD_KERNEL, LAW, MESH, 8)        \
    GEARPOD_PACED_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 4) \
    GEARPOD_PACED_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 1)
