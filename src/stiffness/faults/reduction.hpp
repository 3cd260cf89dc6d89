// A tooth fault known only by what it takes from the gear mesh stiffness while its tooth is
// engaged. Park et al. (2016), section V-A (10, 20, 30 %). Size: the part of the mesh's stiffness
// that is lost, high and low alike.
#pragma once

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

class Reduction : public ToothFaultFamily {
  public:
    std::unique_ptr<const ToothFault> at(double lost) const override;
    double largest_size() const override { return 1; }
};

}  // namespace gearpod::stiffness
