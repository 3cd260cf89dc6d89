#include "stiffness/foundation/gear_blank.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::stiffness {

double gear_blank_factor(double web_over_face, double rim_over_module) {
    const double web = std::clamp(web_over_face, 0.2, 1.2), rim = std::max(rim_over_module, 1.0);
    return 1 + std::log(web) / (5 * std::exp(rim / 5));
}

}  // namespace gearpod::stiffness
