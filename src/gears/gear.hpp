// A standard involute spur gear, external or internal, without profile shift.
// Lengths in metres, angles in radians. Sources: Tian (2004), Eqs. 2.2-2.5, 2.42; Liang (2016),
// Eqs. 2.2.25, 3.2.11.
#pragma once

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

    double pitch_radius() const;
    double base_radius() const;
    // Internal teeth point inwards: their tip circle is the smaller one, their root circle the
    // larger.
    double tip_radius() const;
    double root_radius() const;
    // Half the angle a tooth spans on the base circle: pi/2N + inv a0 (external, alpha_2), pi/2N -
    // inv a0 (internal, beta_2; negative for many teeth, where both flanks meet above the base
    // circle).
    double half_base_angle() const;
};

// tan a - a.
double involute(double angle_rad);

// Everything that keeps this from being a gear, one sentence each; empty if nothing does.
std::vector<std::string> gear_problems(const Gear& gear);

}  // namespace gearpod::gears
