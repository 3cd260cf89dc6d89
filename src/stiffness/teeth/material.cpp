#include "stiffness/teeth/material.hpp"

#include <numbers>

namespace gearpod::stiffness {

double hertz_stiffness(const Material& material) {
    const double nu = material.poisson_ratio;
    return std::numbers::pi * material.youngs_modulus_Pa * material.face_width_m /
           (4 * (1 - nu * nu));
}

}  // namespace gearpod::stiffness
