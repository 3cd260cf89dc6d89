// A tooth cracked straight through its whole width, of every depth, for a gear pair. Section law:
// teeth/crack.hpp. Sources: Tian (2004), section 3.3; Liang (2016), section 3.5.
//
// The cracked tooth's compliance is a polynomial in the cosine of the contact angle whose
// coefficients are cumulative integrals from the root to the contact. They are summed panel by
// panel from contact to contact, so a curve costs one sweep over the tooth, for any depth alike.
#pragma once

#include "gears/mesh_geometry.hpp"
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
               int which, double crack_angle_rad);

    std::unique_ptr<const ToothFault> at(double depth_m) const override;
    // Depth at which the tooth breaks: twice the half root chord / sin(angle).
    double largest_size() const override;

  private:
    friend class CrackOfOneDepth;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }

    ToothProfile profile_;
    Material material_;
    int which_;
    double crack_angle_rad_;
    double contact_ratio_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
};

}  // namespace gearpod::stiffness
