// A broken tooth: its pair carries nothing where it should touch, so that zones with a single pair
// have no stiffness. Tian (2004), section 3.4, Eq. 3.17. Size: the part of the pair's stiffness
// that is lost, 1 being Tian's missing tooth.
#pragma once

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

class BrokenTooth : public ToothFaultFamily {
  public:
    std::unique_ptr<const ToothFault> at(double lost) const override;
    double largest_size() const override { return 1; }
};

}  // namespace gearpod::stiffness
