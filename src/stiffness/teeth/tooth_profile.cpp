#include "stiffness/teeth/tooth_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "machine/elementary_functions.hpp"

namespace gearpod::stiffness {

ToothProfile::ToothProfile(const gears::Gear& gear, Profile profile)
    : internal_(gear.internal),
      base_radius_(gear.base_radius()),
      half_base_angle_(gear.half_base_angle()) {
    const double root_radius = gear.root_radius();
    const bool root_on_involute = root_radius > base_radius_;
    involute_root_ = half_base_angle_;
    if (internal_ || (profile == Profile::root_circle && root_on_involute)) {
        const double roll = std::tan(std::acos(base_radius_ / root_radius));
        // Solves Liang (2016), Eqs. 2.2.25 (phi) and 3.2.21 (alpha_5).
        involute_root_ += internal_ ? roll : -roll;
    }
    if (profile == Profile::fillet && !internal_) {
        add_fillet(gear);
    } else {
        root_ = fillet_end_ = involute_root_;
        if (profile == Profile::root_circle && !internal_) {
            lengthening_radius_ = root_radius;
            // Liang (2016), Eq. 3.2.12: alpha_3 = arcsin(R_b sin alpha_2 / R_r).
            const double half = involute_section(involute_root_).half_thickness;
            if (!root_on_involute)
                add_straight_side(std::sqrt(root_radius * root_radius - half * half));
        }
        waist_ = involute_root_;
        critical_ = root_;
    }
    const ToothSection root = section(root_);
    root_axial_ = root.axial;
    root_half_thickness_ = root.half_thickness;
    add_foot_break(root_);
    for (const double u : {waist_, fillet_end_, involute_root_})
        if (u < foot_breaks_[foot_break_count_ - 1])
            add_foot_break(u);
}

void ToothProfile::add_straight_side(double end_axial) {
    const ToothSection end = involute_section(involute_root_);
    side_axial_ = end.axial;
    side_half_thickness_ = end.half_thickness;
    root_ = fillet_end_ = involute_root_ + (end.axial - end_axial) / base_radius_;
}

void ToothProfile::add_fillet(const gears::Gear& gear) {
    const double root = gear.root_radius();
    fillet_radius_ = (gear.dedendum_coefficient - gear.addendum_coefficient) * gear.module_m /
                     (1 - std::sin(gear.pressure_angle_rad));
    // Yang (2022), Eqs. 10-15, combined. The arc's centre lies on the involute's normal, rho beyond
    // the involute as seen from the base circle, and root + rho from the gear's centre.
    const double centre = (root + fillet_radius_) * (root + fillet_radius_);
    const double roll_length =
        std::sqrt(std::max(0.0, centre - base_radius_ * base_radius_)) - fillet_radius_;
    if (roll_length >= 0) {
        involute_root_ = half_base_angle_ - roll_length / base_radius_;
        root_ = fillet_end_ = involute_root_;
    } else {
        const double end_radius = std::sqrt(centre - fillet_radius_ * fillet_radius_);
        side_taper_ = std::tan(half_base_angle_);
        add_straight_side(end_radius * std::cos(half_base_angle_));
    }
    const ToothSection end = section(fillet_end_);
    // The outward normal at the arc's end is (-sin u, cos u), with u the involute's last angle.
    const double u = involute_root_;
    fillet_axial_ = end.axial - fillet_radius_ * std::sin(u);
    fillet_height_ = end.half_thickness + fillet_radius_ * std::cos(u);
    fillet_end_angle_ = std::numbers::pi / 2 + u;
    root_ = fillet_end_ + fillet_end_angle_ - std::atan2(fillet_height_, fillet_axial_);
    // At the waist the arc runs along the centre line.
    waist_ = fillet_end_ + std::max(0.0, u);
    // At the angle p of the arc the tangent makes pi/2 - p with the centre line.
    constexpr double kTangent = std::numbers::pi / 6;
    critical_ = std::clamp(fillet_end_ + fillet_end_angle_ - (std::numbers::pi / 2 - kTangent),
                           fillet_end_, root_);
}

ToothSection ToothProfile::involute_section(double u) const {
    const auto [sine, cosine] = machine::sine_cosine(u);
    const double roll = half_base_angle_ - u;
    return {base_radius_ * (cosine - roll * sine), base_radius_ * (roll * cosine + sine),
            base_radius_ * std::abs(roll) * cosine};
}

ToothSection ToothProfile::foot_section(double u) const {
    if (u <= fillet_end_) {
        const double below = base_radius_ * (u - involute_root_);
        return {side_axial_ - below, side_half_thickness_ - side_taper_ * below, base_radius_};
    }
    const double angle = fillet_end_angle_ - (u - fillet_end_);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    return {fillet_axial_ - fillet_radius_ * cosine, fillet_height_ - fillet_radius_ * sine,
            fillet_radius_ * sine};
}

double ToothProfile::root_radius() const {
    return std::hypot(root_axial_, root_half_thickness_);
}

double ToothProfile::root_half_angle() const {
    return std::atan2(root_half_thickness_, root_axial_);
}

double ToothProfile::fillet_angle_of_half_thickness(double h) const {
    const double angle = std::asin(std::clamp((fillet_height_ - h) / fillet_radius_, 0.0, 1.0));
    return std::clamp(fillet_end_ + fillet_end_angle_ - angle, waist_, root_);
}

double ToothProfile::angle_of_axial(double xi) const {
    // xi decreases with u on external teeth and increases on internal ones, which point inwards.
    double low = internal_ ? std::max(half_base_angle_, 0.0) : -std::numbers::pi / 2;
    double high = root_;
    const double sign = internal_ ? -1 : 1;
    for (int halving = 0; halving < 54; ++halving) {
        const double middle = 0.5 * (low + high);
        (sign * (section(middle).axial - xi) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double ToothProfile::angle_of_half_thickness(double h) const {
    // dh/du = -R_b (a2 - u) sin u is positive on this bracket, for both kinds of teeth.
    double low = internal_ ? std::max(half_base_angle_, 0.0) : -std::numbers::pi / 2;
    double high = internal_ ? involute_root_ : std::min(0.0, involute_root_);
    if (half_thickness(high) <= h)
        return high;
    if (half_thickness(low) >= h)
        return low;
    double u = high - 0.3 * (high - low);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double excess = half_thickness(u) - h;
        (excess > 0 ? high : low) = u;
        const double newton = u + excess / (base_radius_ * (half_base_angle_ - u) * std::sin(u));
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        const bool converged = std::abs(next - u) < 1e-15;
        u = next;
        if (converged)
            break;
    }
    return u;
}

}  // namespace gearpod::stiffness
