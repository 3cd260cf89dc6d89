// What a tooth pair is made of; both gears share material, face width and helix.
#pragma once

namespace gearpod::stiffness {

struct Material {
    double youngs_modulus_Pa = 0;
    double poisson_ratio = 0;
    double face_width_m = 0;
    bool shear_energy = true;  // whether teeth give way to shear
    // What helical teeth have of the stiffness of spur teeth that look like their transverse
    // section (helical_factors).
    double bending_factor = 1, shear_factor = 1, contact_factor = 1;
};

// Sets the factors. In the transverse plane, in which the gears move, of helix angle b on the
// reference circle and b_b on the base circle, sin b_b = sin b cos a_n: the tooth bends about its
// root line, which leans by b, so the moment grows by 1 / cos b, the section is thinner by cos b
// and longer by 1 / cos b: cos^4 b; shear: cos^2 b; the contact is longer by 1 / cos b_b and its
// approach leans, on both sides of the force: cos b_b. A spur tooth keeps 1.
void set_helix(double helix_angle_rad, double normal_pressure_angle_rad, Material& material);

// Linearised Hertz contact of a tooth pair, pi E L / 4 (1 - nu^2), in N/m.
// Yang and Sun (1985); Tian (2004), Eq. 2.11; Liang (2016), Eqs. 2.2.5 and 3.2.22.
double hertz_stiffness(const Material& material);

}  // namespace gearpod::stiffness
