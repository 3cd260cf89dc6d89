#include "lockstep/kernels/define_driven_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_PACED_MARCHES(linear, dynamics::LinearMesh)

}  // namespace gearpod::lockstep
