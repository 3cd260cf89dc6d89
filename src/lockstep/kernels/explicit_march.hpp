// Kernels of the explicit integrators, one for each mesh law, method, gearbox model, precision and
// width: a mesh period of W gearboxes.
#pragma once

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

#define GEARPOD_EXPLICIT_MARCHES(NAME, W, REAL)                                       \
    MarchKernel<dynamics::PlanetaryLanes<W, REAL>> NAME##_translational_inertial_##W; \
    MarchKernel<dynamics::PlanetaryLanes<W, REAL>> NAME##_translational_##W;          \
    MarchKernel<dynamics::PlanetaryLanes<W, REAL>> NAME##_torsional_##W;              \
    MarchKernel<dynamics::FixedShaftLanes<W, REAL>> NAME##_fixed_shaft_##W;
#define GEARPOD_EXPLICIT_DOUBLES(W, REAL)                        \
    GEARPOD_EXPLICIT_MARCHES(linear_rk4_double, W, REAL)         \
    GEARPOD_EXPLICIT_MARCHES(with_error_rk4_double, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(separating_rk4_double, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(linear_bs3_double, W, REAL)         \
    GEARPOD_EXPLICIT_MARCHES(with_error_bs3_double, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(separating_bs3_double, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(linear_central_double, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(with_error_central_double, W, REAL) \
    GEARPOD_EXPLICIT_MARCHES(separating_central_double, W, REAL)
#define GEARPOD_EXPLICIT_SINGLES(W, REAL)                        \
    GEARPOD_EXPLICIT_MARCHES(linear_rk4_single, W, REAL)         \
    GEARPOD_EXPLICIT_MARCHES(with_error_rk4_single, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(separating_rk4_single, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(linear_central_single, W, REAL)     \
    GEARPOD_EXPLICIT_MARCHES(with_error_central_single, W, REAL) \
    GEARPOD_EXPLICIT_MARCHES(separating_central_single, W, REAL)
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_EXPLICIT_DOUBLES)
GEARPOD_FOR_FLOAT_WIDTHS(GEARPOD_EXPLICIT_SINGLES)
#undef GEARPOD_EXPLICIT_SINGLES
#undef GEARPOD_EXPLICIT_DOUBLES
#undef GEARPOD_EXPLICIT_MARCHES

}  // namespace gearpod::lockstep
