#include "lockstep/bogacki_shampine.hpp"
#include "lockstep/explicit_kernels.hpp"

namespace gearpod::lockstep {

GEARPOD_DOUBLE_MARCHES(with_error_bs3_double, BogackiShampine, dynamics::LinearMeshWithError)

}  // namespace gearpod::lockstep
