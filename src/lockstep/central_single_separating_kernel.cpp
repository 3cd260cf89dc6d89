#include "lockstep/central_difference.hpp"
#include "lockstep/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(separating_central_single, CentralDifference, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
