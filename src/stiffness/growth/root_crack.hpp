// Stress intensity at the tip of a crack that starts at the loaded flank's root and runs at an
// angle into the tooth, under the force of the mesh, by either law of cracks (teeth/crack_law.hpp).
//
// Sections: the plane of the crack, from the root to the other flank's height, is a strip of the
// width w = 2 h_root / sin v, v between crack and centre line. The force across it, and the force's
// moment about its middle, open a single edge crack in tension and bending (teeth/edge_crack.hpp).
// Omitted: shear along the plane (mode II), the body below it, and that the crack turns on its way.
//
// Fracture mechanics: the intensity K_I of teeth/crack_path.hpp, from the critical section.
#pragma once

#include <span>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/crack_path.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

class RootCrack {
  public:
    // which: the gear whose tooth is cracked (1 or 2). face_width_m: of the tooth. Throws
    // std::invalid_argument unless 0 < crack_angle_rad <= pi / 2.
    RootCrack(const gears::MeshGeometry& geometry, Profile profile, int which,
              double crack_angle_rad, double face_width_m, CrackLaw law = CrackLaw::sections);

    double width() const { return width_; }  // depth that cuts the tooth, m

    // K_I, Pa m^(1/2), at a depth in [0, width) for a normal force in N on the tooth, tau mesh
    // periods after its engagement began; 0 where the force closes the crack.
    double intensity(double depth_m, double force_N, double tau) const;

    // The largest intensity of an engagement for a normal force on the mesh, shared equally by the
    // pairs that touch. Since it is 0 before the engagement, it is the range that drives the
    // growth.
    double largest_intensity(double depth_m, double force_N) const;

  private:
    // Stresses in the crack's plane for 1 N on the tooth: mean stress across it, and bending stress
    // at its edge, Pa.
    struct Stress {
        double tension = 0.0, bending = 0.0;
    };
    // A position in the engagement, with a tooth's share of the mesh's force.
    struct Touch {
        double cosine = 0.0, sine = 0.0, share = 0.0;
        Stress stress;
    };
    Stress stress_at(double tau) const;
    Touch touch_at(double tau) const;
    // The largest K_I at these positions for 1 N on the mesh.
    double largest_opening(double depth_m, std::span<const Touch> touches) const;

    gears::MeshGeometry geometry_;
    ToothProfile profile_;
    int which_;
    double angle_, face_width_;
    CrackLaw law_;
    CrackPath path_;
    double width_;
    std::vector<Touch> engagement_;  // from its begin to its end
};

}  // namespace gearpod::stiffness
