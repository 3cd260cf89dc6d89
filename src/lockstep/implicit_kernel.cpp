#include "lockstep/implicit_march.hpp"
#include "lockstep/newmark.hpp"
#include "lockstep/sdirk3.hpp"

namespace gearpod::lockstep {

#define GEARPOD_MARCH(NAME, INTEGRATOR, W)                                                 \
    GEARPOD_KERNEL(                                                                        \
        NAME,                                                                              \
        (const MarchPlan& plan, const ImplicitLanes<W>& lanes,                             \
         const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides, \
         TileState& state, MeshRecord& record),                                            \
        (plan, lanes, filter, overrides, state, record),                                   \
        march<INTEGRATOR, LinearMotion<W>>(plan, lanes, filter, overrides, state, record))

GEARPOD_MARCH(sdirk3_8, Sdirk3, 8)
GEARPOD_MARCH(sdirk3_1, Sdirk3, 1)
GEARPOD_MARCH(newmark_8, Newmark, 8)
GEARPOD_MARCH(newmark_1, Newmark, 1)

#undef GEARPOD_MARCH

}  // namespace gearpod::lockstep
