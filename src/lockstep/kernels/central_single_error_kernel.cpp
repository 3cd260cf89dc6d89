#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_SINGLE_MARCHES(with_error_central_single, CentralDifference, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
