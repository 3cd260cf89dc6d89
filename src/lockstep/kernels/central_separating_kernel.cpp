#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(separating_central_double, CentralDifference, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
