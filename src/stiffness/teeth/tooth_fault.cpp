#include "stiffness/teeth/tooth_fault.hpp"

#include <stdexcept>

namespace gearpod::stiffness {

void ToothFault::beam_compliance(std::span<const double> /*tau*/,
                                 std::span<double> /*compliance*/) const {
    throw std::logic_error("this fault leaves the tooth's sections as they are");
}

}  // namespace gearpod::stiffness
