// Stress intensity at the tip of a crack under the mesh force. The crack starts at the root of the
// loaded flank and runs into the tooth at an angle. Both crack laws are available
// (src/stiffness/teeth/fracture_mechanics.hpp).
//
// Sections: the plane of the crack, from the root to the height of the other flank, is a strip of
// the width w = 2 h_root / sin v. v is the angle between crack and centre line. The force across
// it, and the force's moment about its middle, open a single edge crack in tension and bending
// (src/stiffness/teeth/fracture_mechanics.hpp). Omitted: shear along the plane (mode II), the body
// below the plane, and changes of the crack's direction.
//
// Fracture mechanics: the intensity K_I of src/stiffness/teeth/fracture_mechanics.hpp, from the
// critical section.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

class RootCrack {
  public:
    // which: gear with the cracked tooth (1 or 2). face_width_m: face width of the tooth. Throws
    // std::invalid_argument unless 0 < crack_angle_rad <= pi / 2.
    RootCrack(const gears::MeshGeometry& geometry, Profile profile, int which,
              double crack_angle_rad, double face_width_m, CrackLaw law = CrackLaw::sections);

    // Width of the strip in which the crack runs, m. By sections a crack may cut the tooth at a
    // smaller depth (max_crack_depth).
    double width() const { return width_; }

    // K_I, Pa m^(1/2), at a depth in [0, width) for a normal force in N on the tooth, tau mesh
    // periods after the start of its engagement. 0 where the force closes the crack.
    double intensity(double depth_m, double force_N, double tau) const;

    // Largest intensity in an engagement for a normal force on the mesh, shared equally by the
    // pairs in contact. Because the intensity is 0 before the engagement, it is the range Delta K
    // of the crack growth.
    double largest_intensity(double depth_m, double force_N) const;

  private:
    // Stresses in the crack's plane for 1 N on the tooth: mean stress across the plane, and bending
    // stress at its edge, Pa.
    struct Stress {
        double tension = 0.0, bending = 0.0;
    };
    // Position in the engagement, with the tooth's share of the mesh force.
    struct ContactPoint {
        double cosine = 0.0, sine = 0.0, share = 0.0;
        Stress stress;
    };
    Stress stress_at(double tau) const;
    ContactPoint touch_at(double tau) const;
    // Largest K_I at these positions for 1 N on the mesh.
    double largest_opening(double depth_m, std::span<const ContactPoint> touches) const;

    gears::MeshGeometry geometry_;
    ToothProfile profile_;
    int which_;
    double angle_, face_width_;
    CrackLaw law_;
    CrackPath path_;
    double width_;
    std::vector<ContactPoint> engagement_;  // from its start to its end
};

// Crack growth by Paris' law, da/dN = C (Delta K)^m. P. C. Paris, F. Erdogan, J. Basic Eng. 85
// (1963), 528-533. The range is proportional to the load, Delta K = load k(a), so that load and
// depth separate. The integral of da / (C k(a)^m) from the first depth equals the sum of load^m
// over the cycles, in any order. The model has no threshold and no retardation by overloads.
struct ParisLaw {
    double factor = 0.0;    // C, m per cycle at a range of 1 Pa m^(1/2)
    double exponent = 0.0;  // m
};

// Paris' law from C in its usual unit, mm per cycle at 1 MPa m^(1/2).
ParisLaw paris_law_mm_MPa(double factor, double exponent);

class ParisGrowth {
  public:
    // range(depth): Delta K in Pa m^(1/2) for a load of 1, positive and continuous on [first,
    // last]. Throws std::invalid_argument unless 0 < first < last, C > 0 and the range is positive
    // there.
    ParisGrowth(const ParisLaw& law, std::function<double(double)> range, double first,
                double last);

    // Sum of load^m over the cycles that grow the crack from the first depth to `depth`, which is
    // clamped to [first, last].
    double damage_to(double depth) const;
    // Depth after a sum of load^m over cycles; the last depth if the sum exceeds damage_to(last).
    // NaN for NaN.
    double depth_after(double damage) const;
    // Sum of load^m over `cycles` cycles with this load.
    double damage_of(double load, double cycles) const;

  private:
    double rate_inverse(double depth) const;  // dD/da
    double between(double from, double to) const;

    ParisLaw law_;
    std::function<double(double)> range_;
    std::vector<double> depth_, damage_;  // nodes; the depths grow by a fixed ratio
};

}  // namespace gearpod::stiffness
