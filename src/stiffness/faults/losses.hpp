// Tooth faults described only by a loss of stiffness. Size: lost fraction of the stiffness.
#pragma once

#include <algorithm>

#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

// Loss of the stiffness of the faulty tooth's pair, or of the whole mesh.
class StiffnessLoss : public ToothFault {
  public:
    StiffnessLoss(double lost, bool of_mesh)
        : factor_(1 - std::clamp(lost, 0.0, 1.0)), of_mesh_(of_mesh) {}
    double pair_factor() const override { return of_mesh_ ? 1.0 : factor_; }
    double mesh_factor() const override { return of_mesh_ ? factor_ : 1.0; }

  private:
    double factor_;
    bool of_mesh_;
};

template <bool kOfMesh>
struct StiffnessLosses : ToothFaultFamily {
    std::unique_ptr<const ToothFault> at(double lost) const override {
        return std::make_unique<StiffnessLoss>(lost, kOfMesh);
    }
    double largest_size() const override { return 1; }
};

// Broken tooth: its pair carries no load where it should touch, so that zones with a single pair
// have no stiffness. Tian (2004), section 3.4, Eq. 3.17. A size of 1 is Tian's missing tooth.
using BrokenTooth = StiffnessLosses<false>;

// Loss of gear mesh stiffness while the faulty tooth is engaged, the same for the high and the low
// level. Park et al. (2016), section V-A (10, 20, 30 %).
using Reduction = StiffnessLosses<true>;

}  // namespace gearpod::stiffness
