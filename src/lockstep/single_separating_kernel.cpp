#include "lockstep/explicit_kernels.hpp"
#include "lockstep/runge_kutta.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(separating_rk4_single, RungeKutta4, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
