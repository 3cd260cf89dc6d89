// Broken tooth: its pair carries no load where it should touch, so that zones with a single pair
// have no stiffness. Tian (2004), section 3.4, Eq. 3.17. Size: lost fraction of the pair's
// stiffness; 1 is Tian's missing tooth.
#pragma once

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

class BrokenTooth : public ToothFaultFamily {
  public:
    std::unique_ptr<const ToothFault> at(double lost) const override;
    double largest_size() const override { return 1; }
};

}  // namespace gearpod::stiffness
