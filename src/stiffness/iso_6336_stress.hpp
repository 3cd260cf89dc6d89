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
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/material.hpp"

namespace gearpod::stiffness {

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
