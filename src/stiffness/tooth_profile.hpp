// The sections of one tooth. A section lies at the axial coordinate xi (from the gear's centre,
// along the tooth's centre line) and has the half thickness h(xi). On the involute both follow the
// involute angle u:
//
//     xi = R_b [cos u - (a2 - u) sin u],    h = R_b [(a2 - u) cos u + sin u],    dxi/du = -R_b (a2
//     - u) cos u,
//
// a2 being the half tooth angle on the base circle (beta_2 of an internal gear). External teeth: u
// falls from the root (alpha_2 on the base circle) to the tip; contact at u = -alpha_1 (Tian,
// Eqs. 2.23-2.24). Internal teeth: u rises from the tip to the root (phi); contact at u = beta_1
// (Liang, Eqs. 2.2.20-2.2.25). Lengths in metres.
#pragma once

#include "gears/gear.hpp"

namespace gearpod::stiffness {

// Where the beam of an external tooth begins. base_circle: Tian (2004). root_circle: Liang (2016),
// section 3.2: straight sides from the base circle down to the root circle where root < base,
// involute from the root circle otherwise. An internal tooth begins at its root circle in both.
enum class Profile { base_circle, root_circle };

struct ToothSection {
    double axial = 0;           // xi
    double half_thickness = 0;  // h
    double axial_slope = 0;     // |dxi/du|, m/rad
};

class ToothProfile {
  public:
    ToothProfile(const gears::Gear& gear, Profile profile);

    ToothSection section(double u) const;
    double half_thickness(double u) const { return section(u).half_thickness; }

    // u of a contact at alpha_1 (external) or beta_1 (internal), and back: the map is its own
    // inverse.
    double involute_angle(double contact_angle) const {
        return internal_ ? contact_angle : -contact_angle;
    }
    double base_radius() const { return base_radius_; }
    // The root section, where the uncracked beam begins.
    double root_axial() const { return root_axial_; }
    double root_half_thickness() const { return root_half_thickness_; }
    // Straight sides of half thickness root_half_thickness() between the root section and the
    // involute.
    double straight_length() const { return straight_length_; }
    // u where the involute part begins on the root side.
    double involute_root() const { return involute_root_; }
    // Radius of the circle along which a crack lengthens the beam below the root chord; 0 if it
    // does not.
    double lengthening_radius() const { return lengthening_radius_; }
    // u of the section whose half thickness is h, on the tip side of the thickest section, 0 <= h
    // <= root half thickness (the involute is continued past the tip circle if it must be).
    double angle_of_half_thickness(double h) const;

  private:
    bool internal_ = false;
    double base_radius_ = 0, half_base_angle_ = 0;
    double root_axial_ = 0, root_half_thickness_ = 0, straight_length_ = 0;
    double involute_root_ = 0, lengthening_radius_ = 0;
};

}  // namespace gearpod::stiffness
