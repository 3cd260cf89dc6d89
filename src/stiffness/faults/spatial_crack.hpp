// A crack whose depth, height and angle change along the face width (crack_surface.hpp). Source:
// Yang (2022), section 2.3.
//
// Each slice of the width is a plane crack (crack.hpp); the slices' bending stiffnesses add, so do
// their shear and their foundation stiffnesses (Eqs. 59-60), and the axial one is the healthy
// tooth's. The slices are Gauss points of the crack's length, of equal depth steps, which converge
// faster than slices of equal width. Where the contact lies below a slice's start it does not see
// the crack; the sum then ends exactly where the start's height passes the contact. A crack of one
// height that starts within the contact's range makes the stiffness jump there; as the place moves
// with the size it is one of the fault's breaks, not of its jumps. Sixteen slices leave 2e-5 of the
// compliance where the contact sees the whole crack, and up to 5e-4 where its sight ends within it.
//
// Foundation: the part of the crack below the root section narrows the root, S' = S - q_b sin g
// with q_b = q - l / cos g, and so makes the lever over the width longer by S / S'. What that adds
// to the foundation's compliance is counted with the beam's.
//
// By fracture mechanics (teeth/crack_law.hpp) a slice has the whole tooth's compliance and, with
// its bending, what the crack adds in a tooth of that depth throughout
// (teeth/crack_compliance.hpp). That holds the give of the root, so the foundation stays; heights
// count from the critical section.
#pragma once

#include <memory>

#include "gears/mesh_geometry.hpp"
#include "stiffness/faults/crack_surface.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/teeth/crack_law.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Size: stage of growth, from 0 (healthy) to the number of stages.
class SpatialCrack : public ToothFaultFamily {
  public:
    // which: the gear whose tooth is cracked (1 or 2 of the geometry). foundation: that gear's, as
    // the mesh has it, or null; it must outlive the family. Throws std::invalid_argument with all
    // of growth_problems(), or unless which is 1 or 2.
    SpatialCrack(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 int which, CrackGrowth growth, const FilletFoundation* foundation = nullptr,
                 CrackLaw law = CrackLaw::sections);

    std::unique_ptr<const ToothFault> at(double stage) const override;
    double largest_size() const override { return growth_.stages(); }

  private:
    friend class CrackOfOneStage;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }
    double position_of(double u) const { return (u - contact_start_) / contact_rate_; }

    ToothProfile profile_;
    Material material_;
    int which_;
    CrackGrowth growth_;
    const FilletFoundation* foundation_;
    CrackLaw law_;
    double contact_ratio_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
};

}  // namespace gearpod::stiffness
