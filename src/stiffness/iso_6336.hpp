// Mesh stiffness, gear blank factor and tooth stresses after ISO 6336.
#pragma once

#include <optional>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

// Gear blank factor: fraction of the mesh stiffness that remains where a gear is not a solid disc
// but a rim on a thinner web. ISO 6336-1:2006, 9.3.2.3, for webs in the middle of the face width,
//
//     C_R = 1 + ln(b_s / b) / (5 exp(s_R / (5 m_n))),    0.2 <= b_s / b <= 1.2,  s_R / m_n >= 1.
//
// Values outside these limits are replaced by the limit, as in the standard. b_s: web, b: face
// width, s_R: rim below the tooth's root, m_n: normal module. The factor is a fit to the stiffness
// of the whole pair, contact included, of external gears with a mating gear at least as stiff. A
// web wider than the face (a hub) makes the pair stiffer.
double gear_blank_factor(double web_over_face, double rim_over_module);

// Tooth and mesh stiffness by ISO 6336-1:2006, method B (section 9.3.2), for comparison.
//
//     q' = C1 + C2/z1 + C3/z2 + C4 x1 + C5 x1/z1 + C6 x2 + C7 x2/z2 + C8 x1^2 + C9 x2^2,
//     c' = C_M C_B cos(b) / q' (E / 206 GPa),    c_gamma_alpha = c' (0.75 e_alpha + 0.25),
//
// z: virtual tooth numbers, x: profile shifts of pinion and wheel in normal modules, b: helix
// angle, e_alpha: transverse contact ratio. An internal wheel has z2 = infinity. C_B is the
// basic-rack factor of the pinion, also where the wheel has another rack. C_M = 0.8 is empirical:
// measured teeth are a fifth softer than the theory of q'.
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

// Nominal contact and tooth root stress of a gear pair by ISO 6336:2006, method B, to judge the
// order of magnitude of a load.
//
//     sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt(F_t / (d_1 b) (u + 1) / u)          (ISO 6336-2, Eq. 5)
//     sigma_F0 = F_t / (b m_n) Y_F Y_S Y_beta                                  (ISO 6336-3, Eq. 3)
//
// F_t: nominal tangential force on the reference circle, d_1: reference diameter of gear 1, b: face
// width, u = z_2 / z_1, negative for an internal gear 2. Z_H: zone factor, which is the Hertzian
// pressure at the pitch point; Z_E: elasticity factor of equal materials; Z_eps: contact ratio
// factor; Z_beta = 1 / sqrt(cos beta). Y_F: form factor for a force at the outer point of single
// tooth contact and the section at the 30 degree tangent (60 degrees on an internal gear); Y_S:
// stress correction factor; Y_beta: helix angle factor.
//
// The factors for application, dynamics and load distribution (K) are omitted, as are Z_B and Z_D
// (single contact), Y_B (thin rims) and Y_DT (deep teeth).
struct ToothStress {
    double contact_Pa = 0;                // sigma_H0
    double root_1_Pa = 0, root_2_Pa = 0;  // sigma_F0 of gears 1 and 2; NaN if it is undefined
};

// Helical gears are given by their transverse plane. force_N: along the line of action in that
// plane, not negative. The fillets are those of a rack whose tip radius fills the tip clearance,
// 0.38 modules for standard teeth (ISO 53, profile A); an internal gear has the same rack. Only
// face width, Young's modulus and Poisson's ratio of the material are used.
ToothStress iso_6336_stress(const gears::MeshGeometry& mesh, double helix_angle_rad,
                            const Material& material, double force_N);

}  // namespace gearpod::stiffness
