// Kernels of the explicit integrator, one for each composition of effects and each width: a mesh
// period of W gearboxes. `filter` holds the sensor's coefficients (sensor_filter.hpp).
#pragma once

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/march.hpp"

namespace gearpod::lockstep {

#define GEARPOD_EXPLICIT_MARCH(NAME, LANES)                                                    \
    void NAME(const MarchPlan& plan, const LANES& lanes, const machine::AlignedVector& filter, \
              const std::vector<PairOverride>& overrides, TileState& state, MeshRecord& record);
GEARPOD_EXPLICIT_MARCH(translational_inertial_1, dynamics::PlanetaryLanes<1>)
GEARPOD_EXPLICIT_MARCH(translational_inertial_8, dynamics::PlanetaryLanes<8>)
GEARPOD_EXPLICIT_MARCH(translational_1, dynamics::PlanetaryLanes<1>)
GEARPOD_EXPLICIT_MARCH(translational_8, dynamics::PlanetaryLanes<8>)
GEARPOD_EXPLICIT_MARCH(torsional_1, dynamics::PlanetaryLanes<1>)
GEARPOD_EXPLICIT_MARCH(torsional_8, dynamics::PlanetaryLanes<8>)
GEARPOD_EXPLICIT_MARCH(fixed_shaft_1, dynamics::FixedShaftLanes<1>)
GEARPOD_EXPLICIT_MARCH(fixed_shaft_8, dynamics::FixedShaftLanes<8>)
#undef GEARPOD_EXPLICIT_MARCH

}  // namespace gearpod::lockstep
