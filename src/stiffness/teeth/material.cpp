#include "stiffness/teeth/material.hpp"

#include <cmath>
#include <numbers>

namespace gearpod::stiffness {

double hertz_stiffness(const Material& material) {
    const double nu = material.poisson_ratio;
    return material.contact_factor * std::numbers::pi * material.youngs_modulus_Pa *
           material.face_width_m / (4 * (1 - nu * nu));
}

void set_helix(double helix_angle_rad, double normal_pressure_angle_rad, Material& material) {
    if (helix_angle_rad == 0)
        return;
    const double c = std::cos(helix_angle_rad);
    const double sine = std::sin(helix_angle_rad) * std::cos(normal_pressure_angle_rad);
    material.bending_factor = c * c * c * c;
    material.shear_factor = c * c;
    material.contact_factor = std::sqrt(1 - sine * sine);
}

}  // namespace gearpod::stiffness
