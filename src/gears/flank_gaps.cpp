#include "gears/flank_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearpod::gears {
namespace {

// Relief at a distance from the end of contact.
double relief_at(const FlankRelief& relief, double distance) {
    if (!(relief.tip_m > 0) || distance >= relief.tip_length_m) {
        return 0;
    }
    const double part = 1 - distance / relief.tip_length_m;
    return relief.tip_m * part;
}

struct Point {
    double x, y;
};

// Pressure angle of an involute at a radius; 0 at and below the base circle.
double profile_angle(double base_radius, double radius) {
    return std::acos(std::min(1.0, base_radius / radius));
}

// Angular position of a flank at a radius, for contact on the line of action at the distance x from
// the gear's base tangent point. Angles count from the line of centres, positive towards the side
// from which contact approaches. At the pitch point x is r_b tan(a_w), and the angle on the working
// pitch circle is 0. Valid for gear 1 and for an internal gear 2.
double flank_angle(double base_radius, double working_angle, double x, double radius) {
    return working_angle - x / base_radius + involute(profile_angle(base_radius, radius));
}

Point at_angle(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Gap from the flank of a gear to the tip corner of its mate at `corner`; x is the position on the
// line of action, from that gear's base tangent point.
double gap_to_flank(double base_radius, double working_angle, double x, Point corner) {
    const double radius = std::hypot(corner.x, corner.y);
    return base_radius *
           (flank_angle(base_radius, working_angle, x, radius) - std::atan2(corner.y, corner.x));
}

// Gap before the path of contact between the corner of gear `tip`, `beyond` metres from the path,
// and the flank of its external mate `flank`. For the gap after the path, exchange the gears.
double external_gap(const Gear& flank, const Gear& tip, double distance, double working_angle,
                    double beyond) {
    const double base = tip.base_radius(), tip_radius = tip.tip_radius();
    const double tangents = (flank.base_radius() + base) * std::tan(working_angle);
    const double start = tangents - std::sqrt(tip_radius * tip_radius - base * base);
    const double angle = profile_angle(base, tip_radius) - working_angle + beyond / base;
    const Point corner = at_angle(tip_radius, angle);
    return gap_to_flank(flank.base_radius(), working_angle, start - beyond,
                        {distance - corner.x, corner.y});
}

// Gap between the corner of the ring (gear 2) and the planet's flank, before the path of contact.
double ring_corner_gap(const Gear& planet, const Gear& ring, double distance, double working_angle,
                       double beyond) {
    const double base = ring.base_radius(), tip_radius = ring.tip_radius();
    const double slope = std::tan(working_angle);
    const double start = planet.base_radius() * slope +
                         std::sqrt(tip_radius * tip_radius - base * base) - base * slope;
    const double angle = working_angle - profile_angle(base, tip_radius) + beyond / base;
    const Point corner = at_angle(tip_radius, angle);
    return gap_to_flank(planet.base_radius(), working_angle, start - beyond,
                        {corner.x - distance, corner.y});
}

// Gap between the planet's corner and the ring's flank ahead of it, after the path of contact.
double planet_corner_gap(const Gear& planet, const Gear& ring, double distance,
                         double working_angle, double beyond) {
    const double base = planet.base_radius(), tip_radius = planet.tip_radius();
    const double end = std::sqrt(tip_radius * tip_radius - base * base);
    const double angle = working_angle - profile_angle(base, tip_radius) - beyond / base;
    const Point corner = at_angle(tip_radius, angle);
    const double x = end + beyond + (ring.base_radius() - base) * std::tan(working_angle);
    return -gap_to_flank(ring.base_radius(), working_angle, x, {corner.x + distance, corner.y});
}

double gap_before(const MeshGeometry& mesh, double beyond) {
    const double distance = mesh.centre_distance(), angle = mesh.working_pressure_angle();
    return mesh.internal() ? ring_corner_gap(mesh.gear(1), mesh.gear(2), distance, angle, beyond)
                           : external_gap(mesh.gear(1), mesh.gear(2), distance, angle, beyond);
}

double gap_after(const MeshGeometry& mesh, double beyond) {
    const double distance = mesh.centre_distance(), angle = mesh.working_pressure_angle();
    return mesh.internal() ? planet_corner_gap(mesh.gear(1), mesh.gear(2), distance, angle, beyond)
                           : external_gap(mesh.gear(2), mesh.gear(1), distance, angle, beyond);
}

// Distance beyond the path, in mesh periods, at which an increasing gap reaches a size.
template <class Gap>
double reach(const Gap& gap, double pitch, double gap_m) {
    double low = 0, high = kLongestReach;
    if (gap(high * pitch) <= gap_m) {
        return high;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (gap(middle * pitch) <= gap_m ? low : high) = middle;
    }
    return high;
}

}  // namespace

double relief_gap(const MeshGeometry& mesh, const FlankRelief& gear_1, const FlankRelief& gear_2,
                  double tau) {
    const double since = tau * mesh.base_pitch();
    const double until = (mesh.contact_ratio() - tau) * mesh.base_pitch();
    return relief_at(gear_1, until) + relief_at(gear_2, since);
}

std::vector<double> relief_kinks(const MeshGeometry& mesh, const FlankRelief& gear_1,
                                 const FlankRelief& gear_2) {
    const double ratio = mesh.contact_ratio(), pitch = mesh.base_pitch();
    std::vector<double> kinks;
    const auto add = [&](double amount, double tau) {
        if (amount > 0 && tau > 0 && tau < ratio) {
            kinks.push_back(tau);
        }
    };
    add(gear_2.tip_m, gear_2.tip_length_m / pitch);
    add(gear_1.tip_m, ratio - gear_1.tip_length_m / pitch);
    std::sort(kinks.begin(), kinks.end());
    return kinks;
}

// The specific sliding grows from the pitch point towards both ends of the path.
FlankWear::FlankWear(const MeshGeometry& mesh, int worn_gear)
    : mesh_(mesh),
      worn_gear_(worn_gear),
      largest_(std::max(sliding(0), sliding(mesh.contact_ratio()))) {
    if (!std::isfinite(largest_)) {
        throw std::invalid_argument(
            "contact reaches the base circle of the worn gear, where the specific sliding has no "
            "bound");
    }
}

double FlankWear::sliding(double tau) const {
    return std::abs(mesh_.roll_angle(1, tau) - mesh_.roll_angle(2, tau)) /
           mesh_.roll_angle(worn_gear_, tau);
}

double FlankWear::shape(double tau) const {
    return sliding(std::clamp(tau, 0.0, mesh_.contact_ratio())) / largest_;
}

double corner_gap(const MeshGeometry& mesh, double tau) {
    const double pitch = mesh.base_pitch();
    if (tau < 0) {
        return std::max(0.0, gap_before(mesh, -tau * pitch));
    }
    const double beyond = tau - mesh.contact_ratio();
    return beyond > 0 ? std::max(0.0, gap_after(mesh, beyond * pitch)) : 0.0;
}

CornerReach corner_reach(const MeshGeometry& mesh, double gap_m) {
    const double pitch = mesh.base_pitch();
    return {reach([&](double x) { return gap_before(mesh, x); }, pitch, gap_m),
            reach([&](double x) { return gap_after(mesh, x); }, pitch, gap_m)};
}

}  // namespace gearpod::gears
