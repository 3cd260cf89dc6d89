#include "lockstep/kernels/define_driven_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_PACED_MARCHES(with_error, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
