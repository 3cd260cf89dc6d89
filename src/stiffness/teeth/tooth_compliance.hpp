// Compliance of a tooth as a beam: integrals over its sections, and the compliance at each contact
// position.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Integrals over a tooth's sections that do not depend on the position of the contact. With x = xi
// - xi_root and the contact angle a1 they give the compliance directly, because the arm is (R_b -
// xi_root cos a1) - x cos a1.

// Moments per unit of face width; x in metres.
struct SectionMoments {
    double bending[3] = {0, 0, 0};  // integral of x^m 12 / t^3 dxi, m = 0, 1, 2
    double shear = 0;               // integral of 1 / t dxi
    double axial = 0;               // integral of 1 / (2 h) dxi; not changed by the crack
};

// Compliance, m/N, of a tooth with these moments in contact at the contact angle.
double compliance(const SectionMoments& moments, const ToothProfile& profile,
                  const Material& material, double contact_angle);
// Bending, shear and axial part of the compliance, by the cosine or sine of the contact angle.
double bending_compliance(const SectionMoments& moments, const ToothProfile& profile,
                          const Material& material, double cosine);
double shear_compliance(const SectionMoments& moments, const Material& material, double cosine);
double axial_compliance(const SectionMoments& moments, const Material& material, double sine);

// Accumulates the section integrals of one tooth, healthy or cracked, from the root towards the
// contact by Gauss panels. The relative error is below 1e-12 as long as the range contains no
// removed section.
class SectionSweep {
  public:
    // Accumulates the sections between the beam's start and the involute, for contacts that the
    // crack affects. A broken tooth has no sections. Both arguments must outlive the sweep.
    SectionSweep(const ToothProfile& profile, const CrackedSections& sections);

    // Continues along the involute to u (towards the tip) with the crack's section law.
    void advance(double u);
    const SectionMoments& moments() const { return moments_; }

  private:
    void add_section(double weight, double axial, double thickness, double healthy_thickness);
    void add_lengthening();
    void advance(double to, bool cracked);

    const ToothProfile* profile_;
    const CrackedSections* sections_;
    SectionMoments moments_;
    double u_;
};

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

// Compliance of a healthy tooth of gear `which` as a beam, over the positions of its engagement.
// `tolerance`:
// error relative to the largest value; 0: the smallest possible.
ChebyshevSeries healthy_beam(const gears::MeshGeometry& geometry, const Material& material,
                             const ToothProfile& profile, double tolerance, int which);

}  // namespace gearpod::stiffness
