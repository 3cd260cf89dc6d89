// At what distance and pressure angle two gears work together, with profile shift. Lengths in
// metres, angles in radians; gear 1 is external, tooth numbers of an internal gear 2 count
// negative, shifts do not (gear.hpp). Source: ISO 21771; DIN 3960; with the involute function
//
//     inv a_w = inv a0 + 2 tan a0 (x_1 + x_2) / (z_1 + z_2),    a = (R_b1 + R_b2) / cos a_w
//
// for teeth without backlash.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gears/gear.hpp"

namespace gearpod::gears {

// Centre distance of touching reference circles and of touching base circles: the sum of an
// external pair's radii, the difference of an internal one's.
double reference_centre_distance(const Gear& gear_1, const Gear& gear_2);
double base_centre_distance(const Gear& gear_1, const Gear& gear_2);

// The pressure angle at that distance; 0 if the base circles do not reach it. At the reference
// distance exactly that of the teeth.
double working_angle_at(const Gear& gear_1, const Gear& gear_2, double centre_distance_m);

// At which the shifted teeth fit without backlash; 0 if they do at none. Exactly that of the teeth
// where the shifts cancel.
double tight_working_angle(const Gear& gear_1, const Gear& gear_2);
double tight_centre_distance(const Gear& gear_1, const Gear& gear_2);
// x_1 + x_2 with which they fit at that distance.
double tight_shift_sum(const Gear& gear_1, const Gear& gear_2, double centre_distance_m);

// Undercut that takes flank from the contact, with the shift that avoids it; empty if there is
// none. A fifth of the addendum is harmless: 14 teeth at 20 degrees do without shift (DIN 3960),
// where 18 have no undercut at all.
std::vector<std::string> undercut_problems(const Gear& gear);

// Shifts of a set as drawn, in modules, and its centre distance; `ring` of a planetary
// set, whose first gear is the sun and second the planet.
struct DrawnShifts {
    std::optional<double> first = {}, second = {}, ring = {};
    std::optional<double> centre_distance_m = {};
    bool operator==(const DrawnShifts&) const = default;
};

// All of them. Standard teeth at the standard distance have no centre distance of their own.
struct WorkingShifts {
    double first = 0, second = 0, ring = 0;
    std::optional<double> centre_distance_m = {};
    // Of first and second, so that their tips keep off each other's roots: x_1 + x_2 less what the
    // distance grew by, in modules, if that is positive. An internal pair's clearance only grows.
    double tip_shortening = 0;
};

// Completes what is drawn so that no mesh has backlash. A distance alone is shared out equally to
// the first two gears' shifts. Without a distance, the ring's shift decides if it is drawn: with
// the planet's it fixes the distance and the sun's shift, otherwise the planet's follows (the sun's
// is 0 if it is not drawn). Other shifts that are not drawn are 0. If more is drawn than fits, the
// ring's mesh has backlash or overlaps. The gears are those without shift; ring: null for a pair.
WorkingShifts working_shifts(const Gear& gear_1, const Gear& gear_2, const Gear* ring,
                             const DrawnShifts& drawn);

}  // namespace gearpod::gears
