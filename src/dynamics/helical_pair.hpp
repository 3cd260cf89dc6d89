// A meshing pair of helical gears as one spring along the normal to the tooth: both gears' three
// translations and three rotations, and what of it remains in the transverse plane.
//
// Source: Park et al. (2016), section III-B and Eqs. A1, A2, after Kim (2001). The printed matrices
// are k v v^T of the vectors below but for slips, as far as the scan can be read: y_s y_p (A1) and
// y_p y_r (A2) carry a squared sine for cos^2(omega); in (A2) x_p z_r has cos(omega) for
// sin(omega), and the planet's y and z couple to its own rotations by r_r for r_p. As printed,
// rigid motion would cost energy.
//
// x points from the central gear's axis to the planet's, z along the axes. phi is the pressure
// angle in the normal plane, omega the helix angle, radii are those of the pitch circles.
#pragma once

#include <Eigen/Dense>

namespace gearpod::dynamics {

using PairVector = Eigen::Matrix<double, 12, 1>;
using PairMatrix = Eigen::Matrix<double, 12, 12>;

struct HelicalPair {
    double pressure_angle_rad = 0.0;
    double helix_angle_rad = 0.0;
};

// Deflection over (x, y, z, alpha, beta, gamma) of the sun, then of the planet (A1); of the planet,
// then of the ring (A2). Translations m, rotations rad.
PairVector sun_planet_deflection(const HelicalPair& pair, double sun_radius_m,
                                 double planet_radius_m);
PairVector planet_ring_deflection(const HelicalPair& pair, double planet_radius_m,
                                  double ring_radius_m);

// k v v^T; k is the stiffness along the tooth's normal, N/m.
PairMatrix pair_matrix(const PairVector& deflection, double stiffness_N_m);

// Gears that move in the transverse plane only, x, y and gamma: there v has the length
// sqrt(sin^2 phi + cos^2 phi cos^2 omega) and the direction of the transverse pressure angle
// atan(tan phi / cos omega). So the pair is a spur pair of that pressure angle, its base radii
// r cos(transverse angle) included, whose stiffness is the normal one times the squared length.
double transverse_pressure_angle(double pressure_angle_rad, double helix_angle_rad);
double transverse_stiffness_factor(double pressure_angle_rad, double helix_angle_rad);

}  // namespace gearpod::dynamics
