#include "gears/corner_contact.hpp"

#include <algorithm>
#include <cmath>

#include "gears/working_pair.hpp"

namespace gearpod::gears {

namespace {

struct Point {
    double x, y;
};

// Pressure angle of an involute at a radius; 0 at and below the base circle.
double profile_angle(double base_radius, double radius) {
    return std::acos(std::min(1.0, base_radius / radius));
}

// Angles count from the line of centres, positive towards the side from which contact approaches.
// On the line of action, r_b tan(a_w) - x further on than the base tangent point of gear 1 or of an
// internal gear 2, a gear's flank lies at this angle at a radius; x is the distance of the contact
// from that gear's base tangent point.
double flank_angle(double base_radius, double working_angle, double x, double radius) {
    return working_angle - x / base_radius + involute(profile_angle(base_radius, radius));
}

Point at_angle(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Gap from the flank of an external gear to a point that its driven mate's corner occupies; x is
// the position on the line of action, from that gear's base tangent point.
double gap_to_flank(double base_radius, double working_angle, double x, Point corner) {
    const double radius = std::hypot(corner.x, corner.y);
    return base_radius *
           (flank_angle(base_radius, working_angle, x, radius) - std::atan2(corner.y, corner.x));
}

// The corner of gear `tip` runs ahead of the path by `beyond` metres and misses the flank of its
// external mate `flank`. Both directions of an external pair are alike but for the gears' roles.
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

// The corner of the ring (gear 2) misses the planet's flank before the path.
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

// The planet's corner misses the ring's flank, which lies ahead of it, after the path.
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

// Mesh periods beyond the path at which a growing gap reaches a size.
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
