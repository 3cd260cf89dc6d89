// Tooth of a gear pair cracked straight through its whole width, for every depth. There are two
// laws (src/stiffness/teeth/fracture_mechanics.hpp): the sections that the crack leaves (teeth/crack.hpp; Tian 2004,
// section 3.3; Liang 2016, section 3.5), or the compliance added by the stress intensities
// (src/stiffness/teeth/fracture_mechanics.hpp).
//
// The sections' compliance is a polynomial in the cosine of the contact angle. Its coefficients are
// cumulative integrals from the root to the contact. They are summed panel by panel from contact to
// contact, so that a curve needs one sweep over the tooth for any depth.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Size: depth along the crack, m. Larger depths are treated as the largest; the tooth then carries
// no load.
class ToothCrack : public ToothFaultFamily {
  public:
    // which: gear with the cracked tooth (1 or 2 of the geometry). crack_angle_rad: angle between
    // crack and centre line. Throws std::invalid_argument unless which is 1 or 2 and 0 <
    // crack_angle_rad < pi/2.
    ToothCrack(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
               int which, double crack_angle_rad, CrackLaw law = CrackLaw::sections);

    std::unique_ptr<const ToothFault> at(double depth_m) const override;
    // Depth at which the crack has cut the tooth by its law (max_crack_depth).
    double largest_size() const override;

  private:
    friend class CrackFault;
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
