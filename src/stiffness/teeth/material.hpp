// Material, face width and helix factors of a tooth pair, shared by both gears.
#pragma once

namespace gearpod::stiffness {

struct Material {
    double youngs_modulus_Pa = 0;
    double poisson_ratio = 0;
    double face_width_m = 0;
    bool shear_energy = true;  // true: teeth deform in shear
    // Stiffness of helical teeth over that of spur teeth with the same transverse section
    // (set_helix).
    double bending_factor = 1, shear_factor = 1, contact_factor = 1;
};

// Sets the helix factors in the transverse plane, in which the gears move. b is the helix angle on
// the reference circle and b_b on the base circle, sin b_b = sin b cos a_n. Bending: the tooth
// bends about its root line, which is inclined by b. The moment grows by 1 / cos b, and the section
// is thinner by cos b and longer by 1 / cos b, hence cos^4 b. Shear: cos^2 b. Contact: it is longer
// by 1 / cos b_b and its approach is inclined on both sides of the force, hence cos b_b. A spur
// tooth has factors of 1.
void set_helix(double helix_angle_rad, double normal_pressure_angle_rad, Material& material);

// Linearised Hertz contact stiffness of a tooth pair, pi E L / 4 (1 - nu^2), in N/m. Yang and Sun
// (1985); Tian (2004), Eq. 2.11; Liang (2016), Eqs. 2.2.5 and 3.2.22.
double hertz_stiffness(const Material& material);

}  // namespace gearpod::stiffness
