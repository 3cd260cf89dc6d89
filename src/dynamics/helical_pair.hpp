// Helical gear pair as one spring along the normal of the tooth flank, restricted to the transverse
// plane. Source: Park et al. (2016), section III-B and Eqs. A1, A2, after Kim (2001).
#pragma once

namespace gearpod::dynamics {

// Equivalent spur pair of gears that move only in the transverse plane. phi is the pressure angle
// in the normal plane, omega the helix angle. The spur pair has the transverse pressure angle
// atan(tan phi / cos omega), base radii r cos(transverse angle), and the normal stiffness times the
// factor sin^2 phi + cos^2 phi cos^2 omega.
double transverse_pressure_angle(double pressure_angle_rad, double helix_angle_rad);
double transverse_stiffness_factor(double pressure_angle_rad, double helix_angle_rad);

}  // namespace gearpod::dynamics
