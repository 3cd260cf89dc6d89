#include "lockstep/integrators/central_difference.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(with_error_central_double, CentralDifference, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
