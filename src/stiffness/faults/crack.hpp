// A straight crack from the tooth's root, and the section law it imposes. Lengths in metres, angles
// in radians. Sources: Tian (2004), Eqs. 3.3-3.7; Liang (2016),
// Eqs. 3.5.1-3.5.4, 3.5.7-3.5.8, 3.5.11-3.5.12.
//
// The crack runs from one end of the root chord at the angle v to the tooth's centre line, down to
// the depth q1 cos v below the chord, and then up to the chord's other end. Its tip lies at the
// signed height h_c = h_root - q sin v over the centre line. Cracked sections are those thicker
// than the tip's height, h_x > |h_c|: they keep h_x + h_c. Thinner ones keep 2 h_x before the
// centre line; past it they have lost all their support and are gone.
//
// Two consequences. The involute leaves the base circle radially, so near it a tooth is up to 0.2 %
// thicker than its root chord: even a vanishing crack takes that bulge off one side, and the
// stiffness drops by up to 5e-5 between depth 0 and the first cracked depth. And the compliance of
// a tooth touched beyond the section that is gone, Liang's condition 4 (Eq. 3.5.15), diverges: the
// integrand grows like 1 / (h_x - h_c)^3 up to the end. That tooth carries nothing.
#pragma once

#include "stiffness/tooth_profile.hpp"

namespace gearpod::stiffness {

struct Crack {
    double depth_m = 0;    // along the crack, q1 + q2; 0: no crack
    double angle_rad = 0;  // between the crack and the tooth's centre line, 0 < v < pi/2
};

// Depth at which the crack reaches the root chord's other end and the tooth breaks: twice h_root /
// sin v.
double max_crack_depth(const ToothProfile& profile, double angle_rad);

// The section law of one crack in one tooth.
class CrackedSections {
  public:
    CrackedSections(const ToothProfile& profile, const Crack& crack);

    bool cracked() const { return cracked_; }
    bool broken() const { return broken_; }
    // Past the centre line, where sections thinner than the tip's height are gone.
    bool past_centre() const { return tip_height_ < 0; }
    double tip_height() const { return tip_height_; }  // h_c
    // Involute angle at which the half thickness equals |h_c|: from there to the tip the law
    // changes.
    double boundary() const { return boundary_; }
    // How far below the root chord the beam begins: q1 cos v, then (q_half - q2) cos v; 0 where the
    // profile does not lengthen.
    double lengthening() const { return lengthening_; }
    // Whether a contact at involute angle u has lost its support.
    bool gone(double u) const;
    // Thickness of a section (full, m) on the cracked side of the boundary, given its healthy half
    // thickness.
    double cracked_thickness(double half_thickness) const { return half_thickness + tip_height_; }

  private:
    bool cracked_ = false, broken_ = false;
    double tip_height_ = 0, boundary_ = 0, lengthening_ = 0;
};

}  // namespace gearpod::stiffness
