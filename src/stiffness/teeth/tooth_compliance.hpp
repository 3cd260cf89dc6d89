// Compliance of one tooth as a beam, by Gauss quadrature on panels. It is the reference for tests
// of the fast curves and the source of the healthy tables.
//
//     bending  integral of (R_b - xi cos a1)^2 / (E I) dxi,    I = t^3 L / 12
//     shear    integral of 1.2 cos^2 a1 / (G A) dxi,           A = t L
//     axial    integral of sin^2 a1 / (E A0) dxi               (A0: the uncracked section)
//
// from the root section to the contact, where t is the section's thickness. The arm is the printed
// one. The contact at (xi_1, h) gives (d - x) cos a1 - h sin a1 = xi_1 cos a1 - h sin a1 - xi cos
// a1. The distance of the line of action from the gear's centre, xi_1 cos a1 - h sin a1, is R_b.
// Internal teeth flip the sign inside the square. Tian (2004), Eqs. 2.21-2.32; Liang (2016), Eqs.
// 2.2.17-2.2.27 (2.2.17 lacks the square), 3.2.3-3.2.20.
#pragma once

#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Compliance of a tooth by parts, m/N; infinite where the tooth carries no load.
struct ToothCompliance {
    double bending = 0;
    double shear = 0;
    double axial = 0;
    double total() const { return bending + shear + axial; }
};

// Compliance with a relative error below 1e-12. contact_angle: alpha_1 of an external tooth, beta_1
// of an internal one.
ToothCompliance tooth_compliance(const ToothProfile& profile, const Material& material,
                                 double contact_angle, const Crack& crack = {});

}  // namespace gearpod::stiffness
