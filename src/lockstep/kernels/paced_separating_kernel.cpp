#include "lockstep/kernels/define_driven_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_PACED_MARCHES(separating, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
