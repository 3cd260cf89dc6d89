#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(linear_central_double, CentralDifference, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
