// A tooth cracked straight through its whole width, for every depth, in a gear pair. Two laws
// (teeth/crack_law.hpp): the sections that the crack leaves (teeth/crack.hpp; Tian 2004, section
// 3.3; Liang 2016, section 3.5), or the compliance that its stress intensities add
// (teeth/crack_compliance.hpp).
//
// The sections' compliance is a polynomial in the cosine of the contact angle whose coefficients
// are cumulative integrals from the root to the contact. They are summed panel by panel from
// contact to contact, so a curve costs one sweep over the tooth for any depth.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/crack_law.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Size: depth along the crack, m. Depths beyond the largest count as it and carry nothing.
class ToothCrack : public ToothFaultFamily {
  public:
    // which: the gear whose tooth is cracked (1 or 2 of the geometry); crack_angle_rad: between
    // crack and centre line. Throws std::invalid_argument unless which is 1 or 2 and 0 <
    // crack_angle_rad < pi/2.
    ToothCrack(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
               int which, double crack_angle_rad, CrackLaw law = CrackLaw::sections);

    std::unique_ptr<const ToothFault> at(double depth_m) const override;
    // Depth at which the tooth breaks: the chord at the crack's start / sin(angle).
    double largest_size() const override;

  private:
    friend class CrackBySections;
    friend class CrackByFractureMechanics;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }

    ToothProfile profile_;
    Material material_;
    int which_;
    double crack_angle_rad_;
    CrackLaw law_;
    double contact_ratio_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
};

}  // namespace gearpod::stiffness
