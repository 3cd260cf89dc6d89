#include "gears/gear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::gears {

using std::numbers::pi;

double involute(double angle_rad) {
    return std::tan(angle_rad) - angle_rad;
}

double inverse_involute(double value) {
    if (!(value > 0)) {
        return 0;
    }
    // tan a - a is near a^3 / 3 for small angles, and convex. Newton's method thus converges to the
    // root monotonically from above.
    double angle = std::min(std::cbrt(3 * value), 1.57);
    for (int step = 0; step < 60; ++step) {
        const double slope = std::tan(angle) * std::tan(angle);
        const double next = angle - (involute(angle) - value) / slope;
        if (!(next < angle)) {
            break;
        }
        angle = next;
    }
    return angle;
}

double Gear::pitch_radius() const {
    return teeth * module_m / 2;
}

double Gear::base_radius() const {
    return pitch_radius() * std::cos(pressure_angle_rad);
}

double Gear::tip_radius() const {
    if (given_tip_radius_m) {
        return *given_tip_radius_m;
    }
    const double addendum = (addendum_coefficient + profile_shift - tip_shortening) * module_m;
    return internal ? pitch_radius() - addendum : pitch_radius() + addendum;
}

double Gear::root_radius() const {
    const double dedendum = (dedendum_coefficient - profile_shift) * module_m;
    return internal ? pitch_radius() + dedendum : pitch_radius() - dedendum;
}

double Gear::half_base_angle() const {
    const double inv = involute(pressure_angle_rad);
    const double standard = pi / (2 * teeth) + (internal ? -inv : inv);
    return standard + 2 * profile_shift * std::tan(pressure_angle_rad) / teeth;
}

double Gear::half_angle_at(double radius_m) const {
    const double inv = involute(std::acos(std::min(1.0, base_radius() / radius_m)));
    return internal ? half_base_angle() + inv : half_base_angle() - inv;
}

double Gear::shift_without_undercut() const {
    const double sine = std::sin(pressure_angle_rad);
    return addendum_coefficient - 0.5 * teeth * sine * sine;
}

double Gear::form_radius() const {
    const double sine = std::sin(pressure_angle_rad);
    const double roll =
        pitch_radius() * sine - (addendum_coefficient - profile_shift) * module_m / sine;
    return std::hypot(base_radius(), std::max(0.0, roll));
}

namespace {

void add_inside_out(const Gear& gear, std::vector<std::string>& problems) {
    const bool inside_out = gear.internal ? gear.tip_radius() >= gear.root_radius()
                                          : gear.tip_radius() <= gear.root_radius();
    if (inside_out) {
        problems.push_back(
            fmt::format("the tip circle of {} teeth, {:.6g} mm in diameter, does not lie {} the "
                        "root circle, {:.6g} mm",
                        gear.teeth, 2e3 * gear.tip_radius(), gear.internal ? "inside" : "outside",
                        2e3 * gear.root_radius()));
    }
}

std::vector<std::string> shape_problems(const Gear& gear) {
    std::vector<std::string> problems;
    if (gear.root_radius() <= 0) {
        problems.push_back(fmt::format(
            "{} teeth leave no root circle with a dedendum of {} modules (use more teeth)",
            gear.teeth, gear.dedendum_coefficient - gear.profile_shift));
        return problems;
    }
    add_inside_out(gear, problems);
    if (!gear.internal && gear.tip_radius() < gear.base_radius()) {
        problems.push_back(fmt::format(
            "the tip circle of {} teeth, {:.6g} mm in diameter, lies inside the base circle, "
            "{:.6g} mm, so they have no involute",
            gear.teeth, 2e3 * gear.tip_radius(), 2e3 * gear.base_radius()));
    } else if (gear.tip_radius() < gear.base_radius()) {
        problems.push_back(fmt::format(
            "the tip circle of the internal gear lies inside its base circle, so the involute "
            "does not reach the tip (use at least {:.0f} teeth instead of {})",
            std::ceil(2 * (gear.addendum_coefficient + gear.profile_shift - gear.tip_shortening) /
                      (1 - std::cos(gear.pressure_angle_rad))),
            gear.teeth));
    } else if (gear.half_angle_at(gear.tip_radius()) <= 0) {
        problems.push_back(fmt::format(
            "the flanks of a tooth cross below the tip circle, where it would be {:.3f} mm thick "
            "({} teeth, addendum {:.4g} modules: use a smaller addendum{})",
            1e3 * gear.thickness_at(gear.tip_radius()), gear.teeth,
            std::abs(gear.tip_radius() - gear.pitch_radius()) / gear.module_m,
            gear.profile_shift > 0 ? " or less shift" : ""));
    } else if (const double root = gear.root_radius();
               gear.internal && 2 * pi / gear.teeth - 2 * gear.half_angle_at(root) <= 0) {
        problems.push_back(fmt::format(
            "the spaces between {} internal teeth close before the root circle (shift them by "
            "more than {:g})",
            gear.teeth, gear.profile_shift));
    }
    return problems;
}

}  // namespace

std::vector<std::string> gear_problems(const Gear& gear) {
    std::vector<std::string> problems;
    const auto require = [&](bool holds, std::string message) {
        if (!holds) {
            problems.push_back(std::move(message));
        }
    };
    require(gear.teeth >= 4, fmt::format("a gear has {} teeth (at least 4)", gear.teeth));
    require(gear.module_m > 0, fmt::format("the module is {} m (must be positive)", gear.module_m));
    require(gear.pressure_angle_rad > 0 && gear.pressure_angle_rad < pi / 4,
            fmt::format("the pressure angle is {:.4g} degrees (must lie between 0 and 45)",
                        gear.pressure_angle_rad * 180 / pi));
    require(gear.addendum_coefficient > 0 && gear.dedendum_coefficient >= gear.addendum_coefficient,
            fmt::format("addendum {} and dedendum {} modules (0 < addendum <= dedendum)",
                        gear.addendum_coefficient, gear.dedendum_coefficient));
    return problems.empty() ? shape_problems(gear) : problems;
}

}  // namespace gearpod::gears
