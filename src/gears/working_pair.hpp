// Working centre distance and pressure angle of two gears with profile shift. Lengths in metres,
// angles in radians. Gear 1 is external. Tooth numbers of an internal gear 2 are negative in the
// formula, shifts are not (gear.hpp). Sources: ISO 21771; DIN 3960; with the involute function
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

// Centre distance of touching reference circles, and of touching base circles: the sum of an
// external pair's radii, the difference of an internal pair's.
double reference_centre_distance(const Gear& gear_1, const Gear& gear_2);
double base_centre_distance(const Gear& gear_1, const Gear& gear_2);

// Pressure angle at that distance; 0 if it does not exceed that of the base circles. At the
// reference distance it equals that of the teeth exactly.
double working_angle_at(const Gear& gear_1, const Gear& gear_2, double centre_distance_m);

// Working angle and distance at which the shifted teeth fit without backlash; the angle is 0 if
// there is none. If the shifts cancel, it equals that of the teeth exactly.
double tight_working_angle(const Gear& gear_1, const Gear& gear_2);
double tight_centre_distance(const Gear& gear_1, const Gear& gear_2);
// Sum x_1 + x_2 with which the teeth fit at that distance without backlash.
double tight_shift_sum(const Gear& gear_1, const Gear& gear_2, double centre_distance_m);

// Undercut that removes part of the active flank, with the shift that avoids it; empty if there is
// none. Undercut up to a fifth of the addendum is harmless: 14 teeth at 20 degrees need no shift
// (DIN 3960), and 18 have no undercut.
std::vector<std::string> undercut_problems(const Gear& gear);

// Profile shifts as specified on a drawing, in modules, and the centre distance. `ring` is used for
// a planetary set, whose first gear is the sun and second the planet.
struct SpecifiedShifts {
    std::optional<double> first = {}, second = {}, ring = {};
    std::optional<double> centre_distance_m = {};
    bool operator==(const SpecifiedShifts&) const = default;
};

// Complete set of shifts. Standard teeth at the standard distance have no separate centre distance.
struct WorkingShifts {
    double first = 0, second = 0, ring = 0;
    std::optional<double> centre_distance_m = {};
    // Tip shortening of first and second, which keeps tips and roots apart: x_1 + x_2 minus the
    // increase of the distance, in modules, if positive. It is not needed in an internal pair,
    // whose clearance only grows.
    double tip_shortening = 0;
};

// Completes specified shifts so that no mesh has backlash.
// - A distance alone is divided equally between the first two gears' shifts.
// - Without a distance, a specified ring shift determines the others. With the planet's shift it
//   determines the distance and the sun's shift; otherwise it determines the planet's shift, with a
//   default of 0 for the sun.
// - Other unspecified shifts are 0.
// - If more is specified than fits, a mesh has backlash or overlap.
//
// `gear_1`, `gear_2` and `ring` are the unshifted gears; `ring` is null for a pair.
WorkingShifts working_shifts(const Gear& gear_1, const Gear& gear_2, const Gear* ring,
                             const SpecifiedShifts& specified);

}  // namespace gearpod::gears
