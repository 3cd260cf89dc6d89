// Sections of one tooth. A section lies at the axial coordinate xi (from the gear's centre, along
// the tooth's centre line) and has the half thickness h(xi). Both are functions of one coordinate u
// along the flank, which on the involute is the involute angle:
//
//     xi = R_b [cos u - (a2 - u) sin u],    h = R_b [(a2 - u) cos u + sin u],
//     dxi/du = -R_b (a2 - u) cos u,
//
// where a2 is the half tooth angle on the base circle (beta_2 of an internal gear). External teeth:
// u decreases from the root (alpha_2 on the base circle) to the tip; contact at u = -alpha_1 (Tian,
// Eqs. 2.23-2.24). Internal teeth: u increases from the tip to the root (phi); contact at u =
// beta_1 (Liang, Eqs. 2.2.20-2.2.25). In both cases u is larger at the root. Below the involute, in
// the tooth's foot, u continues to increase: along a straight side by 1 / R_b per metre, along the
// fillet's arc by the angle turned. Lengths in metres.
#pragma once

#include <array>
#include <span>

#include "gears/gear.hpp"

namespace gearpod::stiffness {

// Start of the beam of an external tooth. The beam of an internal tooth always begins at its root
// circle.
//     base_circle  Tian (2004).
//     root_circle  Liang (2016), section 3.2: straight sides from the base circle down to the root
//                  circle where root < base, involute from the root circle otherwise.
//     fillet       Yang (2022), Eqs. 1, 8-15: a circular arc of radius rho_t = c m / (1 - sin a0),
//                  c = dedendum - addendum coefficient, touches the involute on the transition end
//                  circle and the root circle, where the beam begins. His equations have a solution
//                  only where R_r^2 + 2 R_r rho_t >= R_b^2 (from 30 standard teeth at 20 degrees,
//                  although his sun has 28). With fewer teeth the flank continues below the base
//                  circle along the radius, to which the involute is tangent, and the arc touches
//                  that line.
enum class Profile { base_circle, root_circle, fillet };

struct ToothSection {
    double axial = 0;           // xi
    double half_thickness = 0;  // h
    double axial_slope = 0;     // |dxi/du|, m/rad
};

class ToothProfile {
  public:
    ToothProfile(const gears::Gear& gear, Profile profile);

    ToothSection section(double u) const {
        return u > involute_root_ ? foot_section(u) : involute_section(u);
    }
    double half_thickness(double u) const { return section(u).half_thickness; }

    // u of a contact at alpha_1 (external) or beta_1 (internal), and back: the map is its own
    // inverse.
    double involute_angle(double contact_angle) const {
        return internal_ ? contact_angle : -contact_angle;
    }
    bool internal() const { return internal_; }
    double base_radius() const { return base_radius_; }
    // Root section, where the uncracked beam begins.
    double root() const { return root_; }  // its u
    double root_axial() const { return root_axial_; }
    double root_half_thickness() const { return root_half_thickness_; }
    // Radius of the circle through the root section's ends, and half the angle that the section
    // spans on it.
    double root_radius() const;
    double root_half_angle() const;
    // u where the involute part begins on the root side.
    double involute_root() const { return involute_root_; }
    // u of the fillet's end on the transition end circle; root() without a fillet.
    double fillet_end() const { return fillet_end_; }
    double fillet_radius() const { return fillet_radius_; }  // rho_t; 0 without a fillet
    // Descending u from root() to involute_root(), both included, between which the foot's sections
    // change smoothly. The thickness has its minima only at these.
    std::span<const double> foot_breaks() const {
        return {foot_breaks_.data(), static_cast<std::size_t>(foot_break_count_)};
    }
    // u of the foot's thinnest section; of equal ones, the section nearest the tip.
    double waist() const { return waist_; }
    // u of the critical section, where root cracks start. In a fillet the tangent to the arc there
    // makes 30 degrees with the tooth's centre line (ISO 6336-3); otherwise it is the root section.
    // Internal teeth end without a fillet on their root circle, so that their tangent turns through
    // ISO's 60 degrees in the corner there.
    double critical() const { return critical_; }
    // Radius of the circle along which a crack lengthens the beam below the root chord; 0 if it
    // does not.
    double lengthening_radius() const { return lengthening_radius_; }
    // u of the section with half thickness h, on the tip side of the thickest section, 0 <= h <=
    // root half thickness. If necessary, the involute is continued past the tip circle.
    double angle_of_half_thickness(double h) const;
    // u of the section with half thickness h on the fillet, between the root and the waist; that of
    // the waist for a smaller h.
    double fillet_angle_of_half_thickness(double h) const;
    // u of the section at xi, on the tooth or, past its tip, on the continued involute; root() for
    // sections below the root.
    double angle_of_axial(double xi) const;

  private:
    ToothSection involute_section(double u) const;
    ToothSection foot_section(double u) const;
    void add_fillet(const gears::Gear& gear);
    void add_straight_side(double end_axial);
    void add_foot_break(double u) { foot_breaks_[foot_break_count_++] = u; }

    bool internal_ = false;
    double base_radius_ = 0, half_base_angle_ = 0;
    double root_axial_ = 0, root_half_thickness_ = 0;
    double involute_root_ = 0, root_ = 0, waist_ = 0, critical_ = 0, lengthening_radius_ = 0;
    // Straight side from the involute's root section, with the taper h' = dh/dxi.
    double side_axial_ = 0, side_half_thickness_ = 0, side_taper_ = 0;
    // Arc of the fillet about (xi, h): the point at the angle p is centre - rho (cos p, sin p).
    double fillet_end_ = 0, fillet_radius_ = 0;
    double fillet_axial_ = 0, fillet_height_ = 0, fillet_end_angle_ = 0;
    std::array<double, 4> foot_breaks_{};
    int foot_break_count_ = 0;
};

}  // namespace gearpod::stiffness
