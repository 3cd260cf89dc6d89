#include "lockstep/explicit_kernels.hpp"
#include "lockstep/runge_kutta.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(separating_rk4_double, RungeKutta4, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
