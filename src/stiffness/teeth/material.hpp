// What a tooth pair is made of; both gears share material and face width.
#pragma once

namespace gearpod::stiffness {

struct Material {
    double youngs_modulus_Pa = 0;
    double poisson_ratio = 0;
    double face_width_m = 0;
    bool shear_energy = true;  // whether teeth give way to shear
};

// Linearised Hertz contact of a tooth pair, pi E L / 4 (1 - nu^2), in N/m.
// Yang and Sun (1985); Tian (2004), Eq. 2.11; Liang (2016), Eqs. 2.2.5 and 3.2.22.
double hertz_stiffness(const Material& material);

}  // namespace gearpod::stiffness
