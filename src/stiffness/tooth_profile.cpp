#include "stiffness/tooth_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearpod::stiffness {

ToothProfile::ToothProfile(const gears::Gear& gear, Profile profile)
    : internal_(gear.internal),
      base_radius_(gear.base_radius()),
      half_base_angle_(gear.half_base_angle()) {
    const double root_radius = gear.root_radius();
    const bool root_on_involute = root_radius > base_radius_;
    if (internal_ || (profile == Profile::root_circle && root_on_involute)) {
        const double roll = std::tan(std::acos(base_radius_ / root_radius));
        // Liang (2016), Eqs. 2.2.25 (phi) and 3.2.21 (alpha_5), which this solves.
        involute_root_ = half_base_angle_ + (internal_ ? roll : -roll);
    } else {
        involute_root_ = half_base_angle_;
    }
    root_half_thickness_ = section(involute_root_).half_thickness;
    root_axial_ = section(involute_root_).axial;
    if (profile == Profile::root_circle && !internal_) {
        // Liang (2016), Eq. 3.2.12: alpha_3 = arcsin(R_b sin alpha_2 / R_r).
        const double chord_axial =
            std::sqrt(root_radius * root_radius - root_half_thickness_ * root_half_thickness_);
        straight_length_ = root_on_involute ? 0 : root_axial_ - chord_axial;
        root_axial_ -= straight_length_;
        lengthening_radius_ = root_radius;
    }
}

ToothSection ToothProfile::section(double u) const {
    const double cosine = std::cos(u), sine = std::sin(u);
    const double roll = half_base_angle_ - u;
    return {base_radius_ * (cosine - roll * sine), base_radius_ * (roll * cosine + sine),
            base_radius_ * std::abs(roll) * cosine};
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
        const bool settled = std::abs(next - u) < 1e-15;
        u = next;
        if (settled)
            break;
    }
    return u;
}

}  // namespace gearpod::stiffness
