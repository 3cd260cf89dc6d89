// Straight crack from one flank of a tooth, and the section law that it imposes. Lengths in metres,
// angles in radians. Sources: Tian (2004), Eqs. 3.3-3.7; Liang (2016), Eqs. 3.5.1-3.5.4,
// 3.5.7-3.5.8, 3.5.11-3.5.12; Yang (2022), Eqs. 25-58.
//
// The crack starts at the flank, on the root chord or some height above it. It runs at the angle v
// to the tooth's centre line, down by q cos v. Its tip lies at the signed height h_c = h_start - q
// sin v above the centre line. Sections above the crack's lower end whose half thickness exceeds
// the tip's height, h_x > |h_c|, are cracked and keep the thickness h_x + h_c. Thinner sections
// towards the tooth tip keep 2 h_x while h_c >= 0. If the crack has passed the centre line, they
// have lost all support and are removed.
//
// A contact below the start is not affected by the crack: the whole section carries it (Yang's
// condition 3 of section 2.2.2). In case 3, Yang's Eqs. 55-58 print the start as the limit of the
// first integrals, but Eqs. 40-41 the lower end; the lower end is used here.
//
// From the root circle (Liang) the crack also lengthens the beam: down to the depth of the tip
// below the root chord and, past the centre line, up again to the chord's other end.
//
// On the fillet the thickness decreases from the root to the arc's waist. A tip higher than the
// arc's end, h_c > h_te, does not affect the sections above the arc's section of that height
// (Yang's condition 3).
//
// The model has two consequences. First, the involute leaves the base circle radially, so that near
// it a tooth is up to 0.2 % thicker than its root chord. Even a vanishing crack removes that bulge
// on one side, and the stiffness drops by up to 5e-5 between depth 0 and the first cracked depth.
// Second, the compliance of a tooth in contact beyond the removed section, Liang's condition 4 (Eq.
// 3.5.15), diverges, because the integrand grows like 1 / (h_x - h_c)^3 up to the end. That tooth
// carries no load.
#pragma once

#include <algorithm>

#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

struct Crack {
    double depth_m = 0;    // along the crack, q1 + q2; 0: no crack
    double angle_rad = 0;  // between the crack and the tooth's centre line, 0 < v <= pi/2
    double height_m = 0;  // from the root section to the start, along the centre line; not negative
};

// Depth at which the crack has cut the tooth. The crack then reaches the height of the other flank
// at the thinnest section on its way, or at its start. From a root that is the thinnest section,
// the depth is 2 h_root / sin v.
double max_crack_depth(const ToothProfile& profile, double angle_rad, double height_m = 0);

// Section law of one crack in one tooth.
class CrackedSections {
  public:
    CrackedSections(const ToothProfile& profile, const Crack& crack);

    bool cracked() const { return cracked_; }
    // True if the depth is at least the largest: the part above the start carries no load.
    bool broken() const { return broken_; }
    // True if the crack is past the centre line, where sections thinner than the tip's height are
    // removed.
    bool past_centre() const { return tip_height_ < 0; }
    double tip_height() const { return tip_height_; }  // h_c
    // Coordinates along the flank (ToothProfile): the crack's start and, where it is not below the
    // root section, the section of its lower end.
    double start() const { return start_; }
    double lower_end() const { return lower_end_; }
    // Coordinate where the half thickness equals |h_c|. The law changes from there to the tip.
    double boundary() const { return boundary_; }
    // Distance below the root chord at which the beam begins: q1 cos v, then (q_half - q2) cos v,
    // less the start's height. 0 where the profile is not lengthened.
    double lengthening() const { return lengthening_; }
    // True if a contact at u lies above the crack's start and is therefore affected by it.
    bool affects(double u) const { return cracked_ && u < start_; }
    // True if a contact at u has lost its support.
    bool unsupported(double u) const {
        return affects(u) && (broken_ || (past_centre() && u <= boundary_));
    }
    // Full thickness, m, of a section between the crack's lower end and the boundary, from its
    // healthy half thickness.
    double cracked_thickness(double half_thickness) const { return half_thickness + tip_height_; }

  private:
    bool cracked_ = false, broken_ = false;
    double tip_height_ = 0, start_ = 0, lower_end_ = 0, boundary_ = 0, lengthening_ = 0;
};

// Calls part(from, until, cracked) for each stretch of the flank between from and to (towards the
// tip) with a single section law and, in the foot, a smooth profile. Applies to contacts that the
// crack affects.
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
