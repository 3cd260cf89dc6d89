// Involute spur gear, external or internal, with or without profile shift. Lengths in metres,
// angles in radians. Sources: Tian (2004), Eqs. 2.2-2.5, 2.42; Liang (2016), Eqs. 2.2.25, 3.2.11;
// ISO 21771 for profile shift. Positive shift makes the teeth thicker, also on an internal gear,
// whose tip circle becomes smaller. (Some sources use the opposite sign for internal gears.)
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gearpod::gears {

// Members of a planetary train, and the two of a pair on fixed shafts.
enum class Member { sun, planet, ring, carrier, pinion, gear };

struct Gear {
    int teeth = 0;
    bool internal = false;
    double module_m = 0;
    double pressure_angle_rad = 0;
    double addendum_coefficient = 1;
    double dedendum_coefficient = 1.25;
    double profile_shift = 0;   // x, in modules
    double tip_shortening = 0;  // k, in modules: reduction of the addendum
    std::optional<double> given_tip_radius_m = {};

    double pitch_radius() const;  // of the reference circle
    double base_radius() const;
    // Internal teeth point inwards: their tip circle is smaller than their root circle.
    double tip_radius() const;
    double root_radius() const;
    // Half the angle of a tooth on the base circle: pi/2N + inv a0 (external, alpha_2) or pi/2N -
    // inv a0 (internal, beta_2; negative for many teeth, where both flanks meet above the base
    // circle). Profile shift adds 2 x tan a0 / N.
    double half_base_angle() const;
    // Half the angle of a tooth on the circle of radius r, below the base circle that on it, and
    // the tooth thickness along that arc.
    double half_angle_at(double radius_m) const;
    double thickness_at(double radius_m) const { return 2 * radius_m * half_angle_at(radius_m); }
    // Smallest profile shift at which a rack of this addendum with a sharp-cornered tip does not
    // undercut the involute of an external gear: h_a - N sin^2 a0 / 2.
    double shift_without_undercut() const;
    // Radius of the inner end of the involute cut by this rack, at or above the base circle.
    double form_radius() const;
};

// tan a - a.
double involute(double angle_rad);
// Angle between 0 and pi/2 with this involute; 0 for values below 0.
double inverse_involute(double value);

// All reasons why the gear cannot exist, one sentence each; empty if there are none.
std::vector<std::string> gear_problems(const Gear& gear);

}  // namespace gearpod::gears
