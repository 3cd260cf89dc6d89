// Integrals over a tooth's sections that do not know where the tooth is touched. With x = xi -
// xi_root and the contact angle a1 they give the compliance at once, since the arm is (R_b -
// xi_root cos a1) - x cos a1.
#pragma once

#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Per unit of face width; x in metres.
struct SectionMoments {
    double bending[3] = {0, 0, 0};  // integral of x^m 12 / t^3 dxi, m = 0, 1, 2
    double shear = 0;               // integral of 1 / t dxi
    double axial = 0;               // integral of 1 / (2 h) dxi: the crack leaves it alone
};

// m/N, of a tooth with these moments touched at the contact angle.
double compliance(const SectionMoments& moments, const ToothProfile& profile,
                  const Material& material, double contact_angle);
// Its three parts, by the contact angle's cosine or sine.
double bending_compliance(const SectionMoments& moments, const ToothProfile& profile,
                          const Material& material, double cosine);
double shear_compliance(const SectionMoments& moments, const Material& material, double cosine);
double axial_compliance(const SectionMoments& moments, const Material& material, double sine);

// The sections of one tooth, healthy or cracked, gathered from the root towards the contact by
// Gauss panels; relative error below 1e-12 as long as the stretch touches no section that is gone.
class SectionSweep {
  public:
    // Gathers what lies between the beam's start and the involute, for contacts that see the crack.
    // Nothing of a tooth that is broken. Both arguments must outlive the sweep.
    SectionSweep(const ToothProfile& profile, const CrackedSections& sections);

    // Goes on along the involute to u (towards the tip) as the crack has it.
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

}  // namespace gearpod::stiffness
