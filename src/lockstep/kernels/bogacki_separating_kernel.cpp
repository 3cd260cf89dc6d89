#include "lockstep/integrators/bogacki_shampine.hpp"
#include "lockstep/kernels/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(separating_bs3_double, BogackiShampine, dynamics::SeparatingMesh)

}  // namespace gearpod::lockstep
