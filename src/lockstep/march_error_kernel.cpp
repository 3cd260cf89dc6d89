#include "lockstep/explicit_kernels.hpp"
#include "lockstep/runge_kutta.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(with_error_rk4_double, RungeKutta4, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
