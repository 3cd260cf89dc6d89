#include "dynamics/helical_pair.hpp"

#include <cmath>

namespace gearpod::dynamics {
namespace {

// Unit normal of the tooth flank relative to the central gear: radial, tangential and axial
// components.
struct Normal {
    double x, y, z;
};

Normal normal_of(const HelicalPair& pair) {
    const double c = std::cos(pair.pressure_angle_rad);
    return {std::sin(pair.pressure_angle_rad), c * std::cos(pair.helix_angle_rad),
            c * std::sin(pair.helix_angle_rad)};
}

}  // namespace

PairVector sun_planet_deflection(const HelicalPair& pair, double sun_radius_m,
                                 double planet_radius_m) {
    const Normal n = normal_of(pair);
    const double s = sun_radius_m, p = planet_radius_m;
    PairVector v;
    v << n.x, n.y, -n.z, 0.0, s * n.z, s * n.y,  //
        -n.x, -n.y, n.z, 0.0, p * n.z, p * n.y;
    return v;
}

PairVector planet_ring_deflection(const HelicalPair& pair, double planet_radius_m,
                                  double ring_radius_m) {
    const Normal n = normal_of(pair);
    const double p = planet_radius_m, r = ring_radius_m;
    PairVector v;
    v << n.x, -n.y, -n.z, 0.0, p * n.z, -p * n.y,  //
        -n.x, n.y, n.z, 0.0, -r * n.z, r * n.y;
    return v;
}

PairMatrix pair_matrix(const PairVector& deflection, double stiffness_N_m) {
    return stiffness_N_m * PairMatrix(deflection * deflection.transpose());
}

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
