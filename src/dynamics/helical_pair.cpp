#include "dynamics/helical_pair.hpp"

#include <cmath>

namespace gearpod::dynamics {

double transverse_pressure_angle(double pressure_angle_rad, double helix_angle_rad) {
    // The angle of a spur tooth must stay bit-identical.
    return helix_angle_rad == 0.0
               ? pressure_angle_rad
               : std::atan(std::tan(pressure_angle_rad) / std::cos(helix_angle_rad));
}

double transverse_stiffness_factor(double pressure_angle_rad, double helix_angle_rad) {
    const double axial = std::cos(pressure_angle_rad) * std::sin(helix_angle_rad);
    return 1.0 - axial * axial;
}

}  // namespace gearpod::dynamics
