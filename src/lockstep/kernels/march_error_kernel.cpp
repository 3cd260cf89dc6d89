#include "lockstep/integrators/runge_kutta.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(with_error_rk4_double, RungeKutta4, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
