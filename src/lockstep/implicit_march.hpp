// Kernels of the implicit integrators: a mesh period of W gearboxes of any kind. `filter` holds the
// sensor's coefficients (sensor_filter.hpp).
#pragma once

#include "lockstep/implicit_lanes.hpp"

namespace gearpod::lockstep {

#define GEARPOD_IMPLICIT_MARCH(NAME, W)                                                         \
    void NAME(const MarchPlan& plan, const ImplicitLanes<W>& lanes,                             \
              const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides, \
              TileState& state, MeshRecord& record);
GEARPOD_IMPLICIT_MARCH(sdirk3_1, 1)
GEARPOD_IMPLICIT_MARCH(sdirk3_8, 8)
GEARPOD_IMPLICIT_MARCH(newmark_1, 1)
GEARPOD_IMPLICIT_MARCH(newmark_8, 8)
#undef GEARPOD_IMPLICIT_MARCH

}  // namespace gearpod::lockstep
