#include "stiffness/faults/broken.hpp"

#include <algorithm>

namespace gearpod::stiffness {

namespace {

class PairLoss : public ToothFault {
  public:
    explicit PairLoss(double lost) : factor_(1 - std::clamp(lost, 0.0, 1.0)) {}
    double pair_factor() const override { return factor_; }

  private:
    double factor_;
};

}  // namespace

std::unique_ptr<const ToothFault> BrokenTooth::at(double lost) const {
    return std::make_unique<PairLoss>(lost);
}

}  // namespace gearpod::stiffness
