#include "lockstep/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(separating_rk4_double, RungeKutta4, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
