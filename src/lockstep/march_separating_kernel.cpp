#include "lockstep/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_MARCHES(separating, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
