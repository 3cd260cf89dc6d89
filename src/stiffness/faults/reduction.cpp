#include "stiffness/faults/reduction.hpp"

#include <algorithm>

namespace gearpod::stiffness {

namespace {

class MeshLoss : public ToothFault {
  public:
    explicit MeshLoss(double lost) : factor_(1 - std::clamp(lost, 0.0, 1.0)) {}
    double mesh_factor() const override { return factor_; }

  private:
    double factor_;
};

}  // namespace

std::unique_ptr<const ToothFault> Reduction::at(double lost) const {
    return std::make_unique<MeshLoss>(lost);
}

}  // namespace gearpod::stiffness
