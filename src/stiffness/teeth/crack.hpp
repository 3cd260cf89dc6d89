// A straight crack from one flank of a tooth, and the section law it imposes. Lengths in metres,
// angles in radians. Sources: Tian (2004), Eqs. 3.3-3.7; Liang (2016),
// Eqs. 3.5.1-3.5.4, 3.5.7-3.5.8, 3.5.11-3.5.12; Yang (2022), Eqs. 25-58.
//
// The crack starts at the flank, on the root chord or some height above it, and runs at the angle v
// to the tooth's centre line, down by q cos v. Its tip lies at the signed height h_c = h_start - q
// sin v over the centre line. The sections above its lower end, where the thickness is more than
// the tip's height, h_x > |h_c|, are cracked: they keep h_x + h_c. Thinner ones towards the tip
// keep 2 h_x before the centre line; past it they have lost all their support and are gone. A
// contact below the start leaves the crack alone: it is carried by the whole section (Yang's
// condition 3 of section 2.2.2). Yang's case 3 prints the start where his Eqs. 40-41 have the lower
// end as the limit of the first integrals (Eqs. 55-58); here it is the lower end.
//
// From the root circle (Liang) the crack also lengthens the beam: down to the depth of the tip
// below the root chord, and past the centre line up again to the chord's other end.
//
// On the fillet the thickness falls from the root to the arc's waist. A tip higher than the arc's
// end, h_c > h_te, spares all that lies above the arc's section of that height (Yang's condition
// 3).
//
// Two consequences. The involute leaves the base circle radially, so near it a tooth is up to 0.2 %
// thicker than its root chord: even a vanishing crack takes that bulge off one side, and the
// stiffness drops by up to 5e-5 between depth 0 and the first cracked depth. And the compliance of
// a tooth touched beyond the section that is gone, Liang's condition 4 (Eq. 3.5.15), diverges: the
// integrand grows like 1 / (h_x - h_c)^3 up to the end. That tooth carries nothing.
#pragma once

#include <algorithm>

#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

struct Crack {
    double depth_m = 0;    // along the crack, q1 + q2; 0: no crack
    double angle_rad = 0;  // between the crack and the tooth's centre line, 0 < v <= pi/2
    double height_m = 0;  // from the root section to the start, along the centre line; not negative
};

// Depth at which the crack has cut the tooth: it reaches the height of the other flank at the
// thinnest section on its way, or at its start. Twice h_root / sin v from a root that is the
// thinnest section.
double max_crack_depth(const ToothProfile& profile, double angle_rad, double height_m = 0);

// The section law of one crack in one tooth.
class CrackedSections {
  public:
    CrackedSections(const ToothProfile& profile, const Crack& crack);

    bool cracked() const { return cracked_; }
    // The depth is the largest or more: what lies above the start carries nothing.
    bool broken() const { return broken_; }
    // Past the centre line, where sections thinner than the tip's height are gone.
    bool past_centre() const { return tip_height_ < 0; }
    double tip_height() const { return tip_height_; }  // h_c
    // Along the flank (ToothProfile): the crack's start and, where it is no lower than the root
    // section, the section of its lower end.
    double start() const { return start_; }
    double lower_end() const { return lower_end_; }
    // Where the half thickness equals |h_c|: from there to the tip the law changes.
    double boundary() const { return boundary_; }
    // How far below the root chord the beam begins: q1 cos v, then (q_half - q2) cos v, less the
    // start's height; 0 where the profile does not lengthen.
    double lengthening() const { return lengthening_; }
    // Whether a contact at u lies above the crack's start.
    bool sees(double u) const { return cracked_ && u < start_; }
    // Whether a contact at u has lost its support.
    bool gone(double u) const { return sees(u) && (broken_ || (past_centre() && u <= boundary_)); }
    // Thickness of a section (full, m) between the crack's lower end and the boundary, given its
    // healthy half thickness.
    double cracked_thickness(double half_thickness) const { return half_thickness + tip_height_; }

  private:
    bool cracked_ = false, broken_ = false;
    double tip_height_ = 0, start_ = 0, lower_end_ = 0, boundary_ = 0, lengthening_ = 0;
};

// part(from, until, cracked) for each stretch of the flank between from and to (towards the tip) on
// which the section law is one and, in the foot, the profile smooth. For contacts that see the
// crack.
template <typename Part>
void for_section_parts(const ToothProfile& profile, const CrackedSections& sections, double from,
                       double to, Part&& part) {
    while (from > to) {
        double until = to;
        const auto stop_at = [&](double u) { until = u < from ? std::max(until, u) : until; };
        for (const double u : profile.foot_breaks())
            stop_at(u);
        if (sections.cracked()) {
            stop_at(sections.lower_end());
            stop_at(sections.boundary());
        }
        part(from, until,
             sections.cracked() && from <= sections.lower_end() && from > sections.boundary());
        from = until;
    }
}

}  // namespace gearpod::stiffness
