// Helical gear pair as one spring along the normal of the tooth flank: deflection over three
// translations and three rotations of both gears, and its restriction to the transverse plane.
//
// Source: Park et al. (2016), section III-B and Eqs. A1, A2, after Kim (2001). The printed matrices
// are k v v^T of the vectors below, except for printing errors, as far as the scan is legible. y_s
// y_p (A1) and y_p y_r (A2) have a squared sine instead of cos^2(omega). In (A2), x_p z_r has
// cos(omega) instead of sin(omega), and the planet's y and z couple to its own rotations by r_r
// instead of r_p. As printed, rigid motion would need energy.
//
// x points from the central gear's axis to the planet's, z along the axes. phi is the pressure
// angle in the normal plane, omega the helix angle; radii are those of the pitch circles.
#pragma once

#include <Eigen/Dense>

namespace gearpod::dynamics {

using PairVector = Eigen::Matrix<double, 12, 1>;
using PairMatrix = Eigen::Matrix<double, 12, 12>;

struct HelicalPair {
    double pressure_angle_rad = 0.0;
    double helix_angle_rad = 0.0;
};

// Deflection over (x, y, z, alpha, beta, gamma) of the sun and then the planet (A1), or of the
// planet and then the ring (A2). Translations in m, rotations in rad.
PairVector sun_planet_deflection(const HelicalPair& pair, double sun_radius_m,
                                 double planet_radius_m);
PairVector planet_ring_deflection(const HelicalPair& pair, double planet_radius_m,
                                  double ring_radius_m);

// k v v^T; k is the stiffness along the normal of the tooth flank, N/m.
PairMatrix pair_matrix(const PairVector& deflection, double stiffness_N_m);

// Equivalent spur pair of gears that move only in the transverse plane (x, y and gamma). There v
// has the length sqrt(sin^2 phi + cos^2 phi cos^2 omega) and the direction of the transverse
// pressure angle atan(tan phi / cos omega). The spur pair has that pressure angle, base radii r
// cos(transverse angle), and the normal stiffness times the squared length.
double transverse_pressure_angle(double pressure_angle_rad, double helix_angle_rad);
double transverse_stiffness_factor(double pressure_angle_rad, double helix_angle_rad);

}  // namespace gearpod::dynamics
