#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(linear_central_single, CentralDifference, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
