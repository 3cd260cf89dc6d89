#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/explicit_march.hpp"
#include "lockstep/runge_kutta.hpp"

namespace gearpod::lockstep {

using dynamics::FixedShaftLanes;
using dynamics::FixedShaftMotions;
using dynamics::PlanetaryLanes;
using dynamics::TorsionalMotion;
using dynamics::TranslationalMotion;
using dynamics::WithInertialTerms;
using dynamics::WithoutInertialTerms;

#define GEARPOD_MARCH(NAME, LANES, ...)                                                     \
    GEARPOD_KERNEL(                                                                         \
        NAME,                                                                               \
        (const MarchPlan& plan, const LANES& lanes, const machine::AlignedVector& filter,   \
         const std::vector<PairOverride>& overrides, TileState& state, MeshRecord& record), \
        (plan, lanes, filter, overrides, state, record),                                    \
        march<RungeKutta4, __VA_ARGS__>(plan, lanes, filter, overrides, state, record))

GEARPOD_MARCH(translational_inertial_8, PlanetaryLanes<8>,
              TranslationalMotion<WithInertialTerms, 8>)
GEARPOD_MARCH(translational_inertial_1, PlanetaryLanes<1>,
              TranslationalMotion<WithInertialTerms, 1>)
GEARPOD_MARCH(translational_8, PlanetaryLanes<8>, TranslationalMotion<WithoutInertialTerms, 8>)
GEARPOD_MARCH(translational_1, PlanetaryLanes<1>, TranslationalMotion<WithoutInertialTerms, 1>)
GEARPOD_MARCH(torsional_8, PlanetaryLanes<8>, TorsionalMotion<8>)
GEARPOD_MARCH(torsional_1, PlanetaryLanes<1>, TorsionalMotion<1>)
GEARPOD_MARCH(fixed_shaft_8, FixedShaftLanes<8>, FixedShaftMotions<8>)
GEARPOD_MARCH(fixed_shaft_1, FixedShaftLanes<1>, FixedShaftMotions<1>)

#undef GEARPOD_MARCH

}  // namespace gearpod::lockstep
