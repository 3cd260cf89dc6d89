// Tooth fault described only by the gear mesh stiffness lost while its tooth is engaged. Park et
// al. (2016), section V-A (10, 20, 30 %). Size: lost fraction of the mesh stiffness, the same for
// the high and the low level.
#pragma once

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

class Reduction : public ToothFaultFamily {
  public:
    std::unique_ptr<const ToothFault> at(double lost) const override;
    double largest_size() const override { return 1; }
};

}  // namespace gearpod::stiffness
