#include "lockstep/kernels/implicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_MARCHES(separating, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
