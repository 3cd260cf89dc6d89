// Geometry of a mesh of two gears with profile shift: working centre distance and pressure angle,
// undercut, contact ratio and path of contact.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gears/gear.hpp"

namespace gearpod::gears {

// Working centre distance and pressure angle of two gears with profile shift. Lengths in metres,
// angles in radians. Gear 1 is external. Tooth numbers of an internal gear 2 are negative in the
// formula, shifts are not (gear.hpp). Sources: ISO 21771; DIN 3960; with the involute function
//
//     inv a_w = inv a0 + 2 tan a0 (x_1 + x_2) / (z_1 + z_2),    a = (R_b1 + R_b2) / cos a_w
//
// for teeth without backlash.

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

// Contact positions of a tooth pair from the start to the end of its engagement. Positions count in
// mesh periods (base pitches along the line of action). Sources: Tian (2004), Eqs. 2.1, 2.50-2.60,
// 2.71 (external pair); Liang (2016), Eqs. 2.2.13-2.2.14, 2.2.30-2.2.31, 2.3.5-2.3.6 (internal
// pair, pitch point); ISO 21771 for the working pressure angle of shifted gears.

// Geometry of a gear pair. Gear 1 drives and is external: the sun of a sun-planet pair, the planet
// of a ring-planet pair. Contact starts near the root of its tooth, and at the tip of its mate's
// tooth.
class MeshGeometry {
  public:
    // `centre_distance_m` defaults to the distance at which the teeth fit without backlash. Throws
    // std::invalid_argument with all of mesh_problems().
    MeshGeometry(const Gear& gear_1, const Gear& gear_2,
                 std::optional<double> centre_distance_m = {});

    const Gear& gear(int which) const { return which == 1 ? gear_1_ : gear_2_; }
    bool internal() const { return gear_2_.internal; }
    // Mean number of tooth pairs in contact, equal to the length of an engagement in mesh periods.
    double contact_ratio() const { return contact_ratio_; }
    // Mesh periods from the start of an engagement to contact at the pitch point.
    double pitch_position() const { return pitch_position_; }
    // Angle between the contact force and the normal to the tooth's centre line, tau mesh periods
    // after the start of the engagement: alpha_1 of an external tooth, beta_1 of an internal one.
    // It is linear in tau.
    double contact_angle(int which, double tau) const {
        return contact_angle_at_start(which) + contact_angle_rate(which) * tau;
    }
    double contact_angle_at_start(int which) const { return start_[which - 1]; }
    double contact_angle_rate(int which) const { return rate_[which - 1]; }  // rad per mesh period
    double centre_distance() const;
    // Pitch along the line of action, the distance that the contact moves in one mesh period.
    double base_pitch() const;
    double working_pressure_angle() const { return working_angle_; }
    double working_pitch_radius(int which) const;
    // Gap between the non-working flanks along the working pitch circles, m.
    double backlash() const;
    // Roll angle of the contact on gear `which`: its distance along the line of action from the
    // tangent point on the base circle, over the base radius, rad.
    double roll_angle(int which, double tau) const;
    // Contact radius on gear `which`, tau mesh periods after the start of the engagement.
    double contact_radius(int which, double tau) const;
    // Clearance between the tips of gear `which_tip` and the other gear's root circle, m.
    double tip_clearance(int which_tip) const;

  private:
    Gear gear_1_, gear_2_;
    std::optional<double> centre_distance_;  // empty: that without backlash
    double working_angle_ = 0;
    double contact_ratio_ = 0;
    double pitch_position_ = 0;
    double start_[2] = {0, 0};
    double rate_[2] = {0, 0};
};

// All reasons why the gears cannot mesh over their full flanks, one sentence each, including
// gear_problems.
std::vector<std::string> mesh_problems(const Gear& gear_1, const Gear& gear_2,
                                       std::optional<double> centre_distance_m = {});

}  // namespace gearpod::gears
