// GEARPOD_MARCHES(linear, dynamics::LinearMesh) defines the implicit kernels of one mesh law: all
// integrators, all widths. One file a law, so that none compiles for long.
#pragma once

#include "lockstep/integrators/generalized_alpha.hpp"
#include "lockstep/integrators/newmark.hpp"
#include "lockstep/integrators/sdirk3.hpp"
#include "lockstep/kernels/implicit_march.hpp"

#define GEARPOD_MARCH(DEFINE, NAME, INTEGRATOR, MESH, W)                                   \
    DEFINE(                                                                                \
        NAME,                                                                              \
        (const MarchPlan& plan, const ImplicitLanes<W>& lanes,                             \
         const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides, \
         TileState& state, MeshRecord& record),                                            \
        (plan, lanes, filter, overrides, state, record),                                   \
        march<INTEGRATOR, MatrixMotion<MESH, W>>(plan, lanes, filter, overrides, state, record))

#define GEARPOD_MARCHES_OF_WIDTH(DEFINE, LAW, MESH, W)         \
    GEARPOD_MARCH(DEFINE, LAW##_newmark_##W, Newmark, MESH, W) \
    GEARPOD_MARCH(DEFINE, LAW##_sdirk3_##W, Sdirk3, MESH, W)   \
    GEARPOD_MARCH(DEFINE, LAW##_generalized_alpha_##W, GeneralizedAlpha, MESH, W)

#define GEARPOD_MARCHES(LAW, MESH)                                \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_KERNEL, LAW, MESH, 8)        \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 4) \
    GEARPOD_MARCHES_OF_WIDTH(GEARPOD_NARROW_KERNEL, LAW, MESH, 1)
