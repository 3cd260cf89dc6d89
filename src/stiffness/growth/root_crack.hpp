// Stress intensity at the tip of a crack that starts at the loaded flank's root and runs at an
// angle into the tooth, under the force of the mesh. The plane of the crack, from the root to the
// other flank's height, is taken as a strip of the width w = 2 h_root / sin v, v between crack and
// centre line: the force across it, and the force's moment about its middle, open a single edge
// crack in tension and bending (edge_crack.hpp). Left out: shear along the plane (mode II), the
// body below it, and that the crack turns on its way.
#pragma once

#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

class RootCrack {
  public:
    // which: the gear whose tooth is cracked (1 or 2). face_width_m: of the tooth. Throws
    // std::invalid_argument unless 0 < crack_angle_rad <= pi / 2.
    RootCrack(const gears::MeshGeometry& geometry, Profile profile, int which,
              double crack_angle_rad, double face_width_m);

    double width() const { return width_; }  // of the crack's plane, m: the depth that cuts it

    // K_I, Pa m^(1/2), at a depth in [0, width) for a normal force in N on the tooth, tau mesh
    // periods after its engagement began; 0 where the force closes the crack.
    double intensity(double depth_m, double force_N, double tau) const;

    // The largest of an engagement for a normal force on the mesh: where one pair touches it bears
    // all of it, where two do half of it, where three do a third. From 0 before the engagement:
    // the range that drives the growth.
    double largest_intensity(double depth_m, double force_N) const;

  private:
    // What 1 N does to the crack's plane: the stress across it, and at its edge by bending, Pa.
    struct Stress {
        double tension = 0.0, bending = 0.0;
    };
    Stress stress_at(double tau) const;
    static double intensity_of(const Stress& stress, double depth_m, double share);

    gears::MeshGeometry geometry_;
    ToothProfile profile_;
    int which_;
    double angle_, face_width_, width_;
    std::vector<Stress> engagement_;  // of 1 N on the mesh, from its begin to its end
};

}  // namespace gearpod::stiffness
