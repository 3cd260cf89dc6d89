#include "gears/gear.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace gearpod::gears {

using std::numbers::pi;

double involute(double angle_rad) {
    return std::tan(angle_rad) - angle_rad;
}

double Gear::pitch_radius() const {
    return teeth * module_m / 2;
}

double Gear::base_radius() const {
    return pitch_radius() * std::cos(pressure_angle_rad);
}

double Gear::tip_radius() const {
    const double addendum = addendum_coefficient * module_m;
    return internal ? pitch_radius() - addendum : pitch_radius() + addendum;
}

double Gear::root_radius() const {
    const double dedendum = dedendum_coefficient * module_m;
    return internal ? pitch_radius() + dedendum : pitch_radius() - dedendum;
}

double Gear::half_base_angle() const {
    const double inv = involute(pressure_angle_rad);
    return pi / (2 * teeth) + (internal ? -inv : inv);
}

namespace {

// Half the angle an external tooth spans where its flanks have the given radius.
double half_tip_angle(const Gear& gear) {
    const double pressure_angle = std::acos(gear.base_radius() / gear.tip_radius());
    return gear.internal ? gear.half_base_angle() + involute(pressure_angle)
                         : gear.half_base_angle() - involute(pressure_angle);
}

std::vector<std::string> shape_problems(const Gear& gear) {
    std::vector<std::string> problems;
    if (gear.root_radius() <= 0)
        problems.push_back(fmt::format(
            "{} teeth leave no root circle with a dedendum of {} modules (use more teeth)",
            gear.teeth, gear.dedendum_coefficient));
    if (gear.tip_radius() < gear.base_radius())
        problems.push_back(fmt::format(
            "the tip circle of the internal gear lies inside its base circle, so the involute "
            "does not reach the tip (use at least {:.0f} teeth instead of {})",
            std::ceil(2 * gear.addendum_coefficient / (1 - std::cos(gear.pressure_angle_rad))),
            gear.teeth));
    else if (half_tip_angle(gear) <= 0)
        problems.push_back(
            fmt::format("the flanks of a tooth cross below the tip circle ({} teeth, "
                        "addendum {} modules: use a smaller addendum)",
                        gear.teeth, gear.addendum_coefficient));
    return problems;
}

}  // namespace

std::vector<std::string> gear_problems(const Gear& gear) {
    std::vector<std::string> problems;
    const auto require = [&](bool holds, std::string message) {
        if (!holds)
            problems.push_back(std::move(message));
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
