// An involute spur gear, external or internal, with or without profile shift.
// Lengths in metres, angles in radians. Sources: Tian (2004), Eqs. 2.2-2.5, 2.42; Liang (2016),
// Eqs. 2.2.25, 3.2.11; ISO 21771 for profile shift: positive shift makes the teeth thicker, those
// of an internal gear too, so that its tip circle becomes smaller. (Others count an internal gear's
// shift the other way.)
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gearpod::gears {

struct Gear {
    int teeth = 0;
    bool internal = false;
    double module_m = 0;
    double pressure_angle_rad = 0;
    double addendum_coefficient = 1;
    double dedendum_coefficient = 1.25;
    double profile_shift = 0;   // x, in modules
    double tip_shortening = 0;  // k, in modules: what the addendum lacks
    std::optional<double> given_tip_radius_m = {};

    double pitch_radius() const;  // of the reference circle
    double base_radius() const;
    // Internal teeth point inwards: their tip circle is the smaller one, their root circle the
    // larger.
    double tip_radius() const;
    double root_radius() const;
    // Half the angle a tooth spans on the base circle: pi/2N + inv a0 (external, alpha_2), pi/2N -
    // inv a0 (internal, beta_2; negative for many teeth, where both flanks meet above the base
    // circle); with profile shift 2 x tan a0 / N more.
    double half_base_angle() const;
    // The same on the circle of radius r, not below the base circle; and the tooth's thickness
    // there, along the arc.
    double half_angle_at(double radius_m) const;
    double thickness_at(double radius_m) const { return 2 * radius_m * half_angle_at(radius_m); }
    // What profile shift must reach for a rack of this addendum and a sharp-cornered tip to leave
    // the involute of an external gear whole: h_a - N sin^2 a0 / 2.
    double shift_without_undercut() const;
    // Where the involute that this rack cuts ends above the base circle.
    double form_radius() const;
};

// tan a - a.
double involute(double angle_rad);
// The angle between 0 and pi/2 whose involute that is; 0 for values below 0.
double inverse_involute(double value);

// Everything that keeps this from being a gear, one sentence each; empty if nothing does.
std::vector<std::string> gear_problems(const Gear& gear);

}  // namespace gearpod::gears
