// Pits on one or several neighbouring teeth, gathered into a rectangle on the flank: w wide along
// the face, l long along the profile, d deep. Two things follow, both only in the band of the
// profile that the rectangle covers.
// - A tooth touched there is touched on the width L - w: Tian's law of a lost width (2004,
// Eq. 3.1).
// - A section there has lost the area w d at one edge of its thickness t (area A = t L, inertia I =
//   t^3 L / 12). By the parallel-axis theorem, about its own new centroid,
//
//       A' = A - w d,    I' = I - w d^3 / 12 - w d (A / A') (t - d)^2 / 4.
//
//   Bending, shear and axial compression follow A' and I'. The flank being curved, thickness and
//   depth are measured across the tooth.
// Sources that name the fault as the next step: Liang (2016), section 6.2.1; Park (2016), section
// V-A (spalls).
//
// Size: the width w, m; it may be the whole face.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/chebyshev.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

struct PitBand {
    double centre_radius_m = 0;  // of the band's middle, from the gear's centre
    double length_m = 0;         // along the profile
    double depth_m = 0;          // 0: the pits weaken the contact alone
    int teeth = 1;               // neighbours that have them
    // The middle along the face width, 0 to 1 from the end that engages first where the first gear
    // drives; matters to helical teeth.
    double face_centre = 0.5;
};

class ToothPitting : public ToothFaultFamily {
  public:
    // which: the gear whose teeth are pitted (1 or 2 of the geometry).
    ToothPitting(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 int which, const PitBand& band);

    std::unique_ptr<const ToothFault> at(double width_m) const override;
    double largest_size() const override { return material_.face_width_m; }
    std::vector<std::string> problems(double width_m) const override;
    // The ends of the band, where they are touched.
    std::vector<double> jumps() const override { return jumps_; }

  private:
    friend class PitsOfOneWidth;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }

    gears::Gear gear_;
    ToothProfile profile_;
    Material material_;
    int which_;
    PitBand band_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
    double band_root_ = 0, band_tip_ = 0;  // its ends' involute angles, root side first
    ChebyshevSeries healthy_beam_;         // m/N, over tau
    std::vector<double> jumps_;
};

}  // namespace gearpod::stiffness
