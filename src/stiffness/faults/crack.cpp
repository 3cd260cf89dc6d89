#include "stiffness/faults/crack.hpp"

#include <cmath>

namespace gearpod::stiffness {

double max_crack_depth(const ToothProfile& profile, double angle_rad) {
    return 2 * profile.root_half_thickness() / std::sin(angle_rad);
}

CrackedSections::CrackedSections(const ToothProfile& profile, const Crack& crack)
    : cracked_(crack.depth_m > 0) {
    if (!cracked_)
        return;
    const double max_depth = max_crack_depth(profile, crack.angle_rad);
    broken_ = crack.depth_m >= max_depth;
    tip_height_ = profile.root_half_thickness() - crack.depth_m * std::sin(crack.angle_rad);
    boundary_ = profile.angle_of_half_thickness(std::abs(tip_height_));
    if (profile.lengthening_radius() > 0 && !broken_)
        lengthening_ =
            std::cos(crack.angle_rad) * std::min(crack.depth_m, max_depth - crack.depth_m);
}

bool CrackedSections::gone(double u) const {
    return broken_ || (cracked_ && past_centre() && u <= boundary_);
}

}  // namespace gearpod::stiffness
