#include "lockstep/kernels/implicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_MARCHES(linear, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
