// Tooth and mesh stiffness by ISO 6336-1:2006, method B (section 9.3.2), for comparison.
//
//     q' = C1 + C2/z1 + C3/z2 + C4 x1 + C5 x1/z1 + C6 x2 + C7 x2/z2 + C8 x1^2 + C9 x2^2,
//     c' = C_M C_B cos(b) / q' (E / 206 GPa),    c_gamma_alpha = c' (0.75 e_alpha + 0.25),
//
// z: virtual tooth numbers, x: profile shifts of pinion and wheel in normal modules, b: helix
// angle, e_alpha: transverse contact ratio. An internal wheel has z2 = infinity. C_B is the
// basic-rack factor of the pinion, also where the wheel has another rack. C_M = 0.8 is empirical:
// measured teeth are a fifth softer than the theory of q'.
#pragma once

#include <optional>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

inline constexpr double kIso6336MeasuredOverTheory = 0.8;  // C_M

// Stiffnesses times the face width, N/m. The gear blank factor C_R is omitted.
struct Iso6336Stiffness {
    double single = 0;  // c', largest stiffness of one tooth pair
    double mesh = 0;    // c_gamma_alpha, mean over a mesh period
};

// Helical gears are given by their transverse plane. Empty outside the limits of the formula: a sum
// of profile shifts from -0.5 to 2, and a contact ratio of at least 1.2.
std::optional<Iso6336Stiffness> iso_6336_stiffness(const gears::MeshGeometry& mesh,
                                                   double helix_angle_rad,
                                                   const Material& material);

}  // namespace gearpod::stiffness
