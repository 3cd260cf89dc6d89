// Tooth of which a part has broken off: its whole thickness, over the width w from one end of the
// face, above a plane across the tooth at the height b below the tip circle. Above the plane the
// sections and the contact keep the width L - w,
//
//     A = t (L - w),    I = t^3 (L - w) / 12.
//
// F. Chaari, W. Baccar, M. S. Abbes, M. Haddar, Eur. J. Mech. A/Solids 27 (2008), 691-705, treat
// breakage as such a loss of width. All compliances of a section are inversely proportional to its
// width. So a contact above the plane has
//
//     C' = C + w / (L - w) (C - C_b),    C_c' = C_c L / (L - w),
//
// where C is the compliance of the whole tooth as a beam, C_b the part of the sections below the
// plane, and C_c the compliance of the contact. A contact below the plane is not affected. Unlike a
// chip (chip.hpp), the breakage weakens the beam, too.
//
// On helical teeth the width w at one end of the face is weaker (ToothFault::face).
//
// Size: the width w, m, up to the whole face width; the tooth then carries no load above the plane.
#pragma once

#include <optional>

#include "gears/mesh_geometry.hpp"
#include "stiffness/faults/chip.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

class ToothBreakage : public ToothFaultFamily {
  public:
    // which: gear with the broken tooth (1 or 2 of the geometry). height_m: b; without it, the
    // height of the involute flank.
    ToothBreakage(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                  int which, std::optional<double> height_m = {}, FaceEnd end = FaceEnd::first);

    std::unique_ptr<const ToothFault> at(double width_m) const override;
    double largest_size() const override { return material_.face_width_m; }
    std::vector<std::string> problems(double width_m) const override;
    // Position of the plane, where the contact passes it.
    std::vector<double> jumps() const override { return jumps_; }

    double flank_height() const { return flank_height_; }  // along the centre line, m

  private:
    friend class BreakageFault;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }

    ToothProfile profile_;
    Material material_;
    int which_;
    FaceEnd end_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
    double flank_height_, height_;
    double plane_;                  // involute angle of the plane
    ChebyshevSeries healthy_beam_;  // m/N, over tau
    std::vector<double> jumps_;
};

}  // namespace gearpod::stiffness
