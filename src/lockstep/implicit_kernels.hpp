// GEARPOD_MARCHES(linear, dynamics::LinearMesh) defines the implicit kernels of one mesh law: both
// integrators, all widths. One file a law, so that none compiles for long.
#pragma once

#include "lockstep/implicit_march.hpp"
#include "lockstep/newmark.hpp"
#include "lockstep/sdirk3.hpp"

#define GEARPOD_MARCH(DEFINE, NAME, INTEGRATOR, MESH, W)                                   \
    DEFINE(                                                                                \
        NAME,                                                                              \
        (const MarchPlan& plan, const ImplicitLanes<W>& lanes,                             \
         const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides, \
         TileState& state, MeshRecord& record),                                            \
        (plan, lanes, filter, overrides, state, record),                                   \
        march<INTEGRATOR, MatrixMotion<MESH, W>>(plan, lanes, filter, overrides, state, record))

#define GEARPOD_MARCHES(LAW, MESH)                                          \
    GEARPOD_MARCH(GEARPOD_KERNEL, LAW##_newmark_8, Newmark, MESH, 8)        \
    GEARPOD_MARCH(GEARPOD_KERNEL, LAW##_sdirk3_8, Sdirk3, MESH, 8)          \
    GEARPOD_MARCH(GEARPOD_NARROW_KERNEL, LAW##_newmark_4, Newmark, MESH, 4) \
    GEARPOD_MARCH(GEARPOD_NARROW_KERNEL, LAW##_sdirk3_4, Sdirk3, MESH, 4)   \
    GEARPOD_MARCH(GEARPOD_NARROW_KERNEL, LAW##_newmark_1, Newmark, MESH, 1) \
    GEARPOD_MARCH(GEARPOD_NARROW_KERNEL, LAW##_sdirk3_1, Sdirk3, MESH, 1)
