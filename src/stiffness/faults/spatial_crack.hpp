// Crack whose depth, height and angle vary along the face width (crack_surface.hpp). Source: Yang
// (2022), section 2.3.
//
// Each slice of the width has a plane crack (crack.hpp). The bending stiffnesses of the slices add,
// and by sections so do their shear and their foundation stiffnesses (Eqs. 59-60). The axial
// stiffness is the healthy tooth's. The slices are Gauss points of the crack's length, of equal
// depth steps, which converge faster than slices of equal width.
//
// A contact below a slice's start is not affected by that slice's crack. The sum then ends exactly
// where the height of the start passes the contact. A crack of constant height that starts within
// the contact's range makes the stiffness jump there. As that position depends on the size, it is
// one of the fault's breaks but not of its jumps. The error of sixteen slices is 2e-5 of the
// compliance where the whole crack affects the contact, and up to 5e-4 where only part of it does.
//
// Foundation: the part of the crack below the root section narrows the root to S' = S - q_b sin g
// with q_b = q - l / cos g. It thereby increases the ratio of lever to width by the factor S / S'.
// The added foundation compliance is included in that of the beam.
//
// By fracture mechanics (teeth/crack_law.hpp) a slice has the whole tooth's compliance and, in
// bending, the compliance that the crack adds in a tooth of that depth throughout
// (teeth/crack_compliance.hpp). This includes the deformation of the root, so the foundation is
// unchanged. Heights are measured from the critical section. The slices of tooth, contact and mate
// are in series and these add along the face; the mate counts as an equal healthy tooth. Added in
// bending alone, slices without a crack would take over the load and hide a crack over part of the
// face: solid finite elements lose up to four times as much.
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
    // which: gear with the cracked tooth (1 or 2 of the geometry). foundation: that gear's
    // foundation in the mesh, or null; it must outlive the family. Throws std::invalid_argument
    // with all of growth_problems(), or unless which is 1 or 2.
    SpatialCrack(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 int which, CrackGrowth growth, const FilletFoundation* foundation = nullptr,
                 CrackLaw law = CrackLaw::sections);

    std::unique_ptr<const ToothFault> at(double stage) const override;
    double largest_size() const override { return growth_.stages(); }

  private:
    friend class SpatialCrackFault;
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
