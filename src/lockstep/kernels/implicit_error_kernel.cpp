#include "lockstep/kernels/implicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_MARCHES(with_error, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
