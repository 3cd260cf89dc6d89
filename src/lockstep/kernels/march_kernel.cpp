#include "lockstep/integrators/runge_kutta.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(linear_rk4_double, RungeKutta4, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
