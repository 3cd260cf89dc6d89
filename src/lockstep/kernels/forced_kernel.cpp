#include "lockstep/kernels/define_driven_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_FORCED_MARCHES(linear, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
