// Tooth with a chip at one end of its tip. The contact's width decreases along a hyperbola towards
// the tip, and with it only the Hertz stiffness. The beam keeps its stiffness. Tian (2004), section
// 3.2, Eqs. 3.1-3.4.
//
//     L_c = L                                                        0 <= d_c <= d_h - b
//     L_c = (d_h^2 z / b - d_h z) / d_c + L - d_h z / b,     d_h - b <= d_c <= d_h
//
// L_c thus falls from the whole width L at the depth b below the tip to L - z at the tip. d_c is
// the contact's distance along the tooth's centre line from the section at the base circle (Eq.
// 3.3), or at the root circle where that is larger and for internal teeth.
//
// Tian calls d_h the distance between roof and root. It is taken as the radial distance of the tip
// circle from the circle where d_c is 0, because only this starts the chip at his 22.4 degrees
// (22.42; the distance from section to section gives 22.96, and with the whole tooth's height no
// contact reaches the chip). Contacts beyond d_h, the last tenth of a millimetre in his case, are
// treated as at d_h.
//
// On helical teeth the chip lies at one end of the face width, over the length z
// (ToothFault::face).
//
// Size: length z of the chip along the face, m. Its depth b is given, or a quarter of the length,
// as in Tian's case (z = 8 mm, b = 2 mm).
#pragma once

#include <optional>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// End of the face width that engages first or last when the first gear is the driver.
enum class FaceEnd { first, last };

class ToothChip : public ToothFaultFamily {
  public:
    static constexpr double kDepthOverLength = 0.25;

    // which: gear with the chipped tooth (1 or 2 of the geometry). depth_m: b for all lengths.
    ToothChip(const gears::MeshGeometry& geometry, double face_width_m, int which,
              std::optional<double> depth_m = {}, FaceEnd end = FaceEnd::first);

    std::unique_ptr<const ToothFault> at(double length_m) const override;
    // Face width, or the length at which the chip is as deep as the tooth is high.
    double largest_size() const override;
    std::vector<std::string> problems(double length_m) const override;

    double tooth_height() const { return height_; }  // d_h, m

  private:
    friend class ChipFault;
    double depth(double length_m) const {
        return depth_m_ ? *depth_m_ : kDepthOverLength * length_m;
    }
    double distance(double tau) const;         // d_c
    double position(double distance_m) const;  // tau at a given d_c

    ToothProfile profile_;  // root circle: its involute begins where d_c is 0
    double face_width_m_;
    int which_;
    std::optional<double> depth_m_;
    FaceEnd end_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
    double foot_axial_ = 0, height_ = 0;
};

}  // namespace gearpod::stiffness
