// Pits on one or several neighbouring teeth, combined into a rectangle on the flank: w wide along
// the face, l long along the profile, d deep. They have two effects, both only in the band of the
// profile that the rectangle covers.
// - The contact there has the width L - w: Tian's law of a lost width (2004, Eq. 3.1).
// - A section there has lost the area w d at one edge of its thickness t (area A = t L, moment of
//   inertia I = t^3 L / 12). By the parallel-axis theorem, about its new centroid,
//
//       A' = A - w d,    I' = I - w d^3 / 12 - w d (A / A') (t - d)^2 / 4.
//
//   Bending, shear and axial compression follow A' and I'. Because the flank is curved, thickness
//   and depth are measured across the tooth.
//
// Sources that name this fault as future work: Liang (2016), section 6.2.1; Park (2016), section
// V-A (spalls).
//
// Size: the width w, m, up to the whole face width.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

struct PitBand {
    double centre_radius_m = 0;  // middle of the band, from the gear's centre
    double length_m = 0;         // along the profile
    double depth_m = 0;          // 0: the pits weaken only the contact
    int teeth = 1;               // number of neighbouring pitted teeth
    // Middle of the band along the face width, 0 to 1 from the end that engages first when the
    // first gear is the driver. Relevant to helical teeth only.
    double face_centre = 0.5;
};

class ToothPitting : public ToothFaultFamily {
  public:
    // which: gear with the pitted teeth (1 or 2 of the geometry).
    ToothPitting(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 int which, const PitBand& band);

    std::unique_ptr<const ToothFault> at(double width_m) const override;
    double largest_size() const override { return material_.face_width_m; }
    std::vector<std::string> problems(double width_m) const override;
    // Positions of the band's ends, where the contact passes them.
    std::vector<double> jumps() const override { return jumps_; }

  private:
    friend class PittingFault;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }

    gears::Gear gear_;
    ToothProfile profile_;
    Material material_;
    int which_;
    PitBand band_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
    // involute angles of the band's ends on the root and tip side
    double band_root_ = 0, band_tip_ = 0;
    ChebyshevSeries healthy_beam_;  // m/N, over tau
    std::vector<double> jumps_;
};

}  // namespace gearpod::stiffness
