// Kernels of gearboxes that are driven unevenly, in double precision, one for each mesh law,
// gearbox model and width: forced_* under forces that vary, by rk4 and sdirk3, paced_* with a speed
// that fluctuates (and such forces), by rk4.
#pragma once

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/driven/forced_motion.hpp"

namespace gearpod::lockstep {

template <int W>
using DrivenPlanetaryLanes = DrivenLanes<dynamics::PlanetaryLanes<W, double>, W>;
template <int W>
using DrivenFixedShaftLanes = DrivenLanes<dynamics::FixedShaftLanes<W, double>, W>;
template <int W>
using DrivenImplicitLanes = DrivenLanes<ImplicitLanes<W>, W>;

#define GEARPOD_DRIVEN_MARCHES(LAW, KIND, W)                                        \
    MarchKernel<DrivenPlanetaryLanes<W>> LAW##_##KIND##_translational_inertial_##W; \
    MarchKernel<DrivenPlanetaryLanes<W>> LAW##_##KIND##_translational_##W;          \
    MarchKernel<DrivenPlanetaryLanes<W>> LAW##_##KIND##_torsional_##W;              \
    MarchKernel<DrivenFixedShaftLanes<W>> LAW##_##KIND##_fixed_shaft_##W;
#define GEARPOD_DRIVEN_MARCHES_OF_WIDTH(W, REAL)                      \
    GEARPOD_DRIVEN_MARCHES(linear, forced, W)                         \
    GEARPOD_DRIVEN_MARCHES(with_error, forced, W)                     \
    GEARPOD_DRIVEN_MARCHES(separating, forced, W)                     \
    GEARPOD_DRIVEN_MARCHES(linear, paced, W)                          \
    GEARPOD_DRIVEN_MARCHES(with_error, paced, W)                      \
    GEARPOD_DRIVEN_MARCHES(separating, paced, W)                      \
    MarchKernel<DrivenImplicitLanes<W>> linear_forced_sdirk3_##W;     \
    MarchKernel<DrivenImplicitLanes<W>> with_error_forced_sdirk3_##W; \
    MarchKernel<DrivenImplicitLanes<W>> separating_forced_sdirk3_##W;
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_DRIVEN_MARCHES_OF_WIDTH)
#undef GEARPOD_DRIVEN_MARCHES_OF_WIDTH
#undef GEARPOD_DRIVEN_MARCHES

}  // namespace gearpod::lockstep
