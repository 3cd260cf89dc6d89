#include "lockstep/integrators/runge_kutta.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(with_error_rk4_single, RungeKutta4, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
