// Kernels of the implicit integrators, one for each mesh law and width; they serve every gearbox
// kind.
#pragma once

#include "lockstep/integrators/implicit_lanes.hpp"

namespace gearpod::lockstep {

#define GEARPOD_IMPLICIT_MARCHES(LAW, W)             \
    MarchKernel<ImplicitLanes<W>> LAW##_newmark_##W; \
    MarchKernel<ImplicitLanes<W>> LAW##_sdirk3_##W;  \
    MarchKernel<ImplicitLanes<W>> LAW##_generalized_alpha_##W;
GEARPOD_IMPLICIT_MARCHES(linear, 1)
GEARPOD_IMPLICIT_MARCHES(linear, 4)
GEARPOD_IMPLICIT_MARCHES(linear, 8)
GEARPOD_IMPLICIT_MARCHES(with_error, 1)
GEARPOD_IMPLICIT_MARCHES(with_error, 4)
GEARPOD_IMPLICIT_MARCHES(with_error, 8)
GEARPOD_IMPLICIT_MARCHES(separating, 1)
GEARPOD_IMPLICIT_MARCHES(separating, 4)
GEARPOD_IMPLICIT_MARCHES(separating, 8)
#undef GEARPOD_IMPLICIT_MARCHES

}  // namespace gearpod::lockstep
