#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(separating_central_single, CentralDifference, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
