// Kernels of the explicit integrator, one for each composition of effects and each width: a mesh
// period of W gearboxes. `filter` holds the sensor's coefficients (sensor_filter.hpp).
#pragma once

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/march.hpp"

namespace gearpod::lockstep {

#define GEARPOD_EXPLICIT_MARCHES(LAW, W)                                       \
    MarchKernel<dynamics::PlanetaryLanes<W>> LAW##_translational_inertial_##W; \
    MarchKernel<dynamics::PlanetaryLanes<W>> LAW##_translational_##W;          \
    MarchKernel<dynamics::PlanetaryLanes<W>> LAW##_torsional_##W;              \
    MarchKernel<dynamics::FixedShaftLanes<W>> LAW##_fixed_shaft_##W;
GEARPOD_EXPLICIT_MARCHES(linear, 1)
GEARPOD_EXPLICIT_MARCHES(linear, 4)
GEARPOD_EXPLICIT_MARCHES(linear, 8)
GEARPOD_EXPLICIT_MARCHES(with_error, 1)
GEARPOD_EXPLICIT_MARCHES(with_error, 4)
GEARPOD_EXPLICIT_MARCHES(with_error, 8)
GEARPOD_EXPLICIT_MARCHES(separating, 1)
GEARPOD_EXPLICIT_MARCHES(separating, 4)
GEARPOD_EXPLICIT_MARCHES(separating, 8)
#undef GEARPOD_EXPLICIT_MARCHES

}  // namespace gearpod::lockstep
