#include "lockstep/explicit_kernels.hpp"
#include "lockstep/runge_kutta.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(linear_rk4_double, RungeKutta4, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
