#include "lockstep/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(linear_rk4_single, RungeKutta4, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
