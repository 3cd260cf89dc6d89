#include "stiffness/teeth/crack.hpp"

#include <cmath>

namespace gearpod::stiffness {

namespace {

// Axial coordinate at a height above the root section.
double axial_at(const ToothProfile& profile, double height_m) {
    return profile.root_axial() + (profile.internal() ? -height_m : height_m);
}

double start_of(const ToothProfile& profile, double height_m) {
    return height_m > 0 ? profile.angle_of_axial(axial_at(profile, height_m)) : profile.root();
}

}  // namespace

double max_crack_depth(const ToothProfile& profile, double angle_rad, double height_m) {
    const double start_u = start_of(profile, height_m);
    const double start = profile.half_thickness(start_u);
    const ToothSection waist = profile.section(profile.waist());
    const double to_flank = 2 * start / std::sin(angle_rad);
    if (start_u > profile.waist() || waist.half_thickness >= start)
        return start_u > profile.waist()
                   ? (start + std::min(start, waist.half_thickness)) / std::sin(angle_rad)
                   : to_flank;
    // The waist limits the depth once the crack's lower end has reached it.
    const double to_waist =
        std::abs(axial_at(profile, height_m) - waist.axial) / std::cos(angle_rad);
    return std::min(to_flank,
                    std::max((start + waist.half_thickness) / std::sin(angle_rad), to_waist));
}

CrackedSections::CrackedSections(const ToothProfile& profile, const Crack& crack)
    : cracked_(crack.depth_m > 0), start_(start_of(profile, crack.height_m)) {
    if (!cracked_)
        return;
    const double max_depth = max_crack_depth(profile, crack.angle_rad, crack.height_m);
    broken_ = crack.depth_m >= max_depth;
    tip_height_ = profile.half_thickness(start_) - crack.depth_m * std::sin(crack.angle_rad);
    const double height = std::abs(tip_height_);
    const bool on_fillet =
        start_ > profile.fillet_end() && height > profile.half_thickness(profile.fillet_end());
    boundary_ = on_fillet ? profile.fillet_angle_of_half_thickness(height)
                          : profile.angle_of_half_thickness(height);
    const double above_root = crack.height_m - crack.depth_m * std::cos(crack.angle_rad);
    lower_end_ =
        above_root > 0 ? profile.angle_of_axial(axial_at(profile, above_root)) : profile.root();
    // The tooth may be thinner below the start than at it. The crack then leaves through the other
    // flank before its depth reaches the start's chord; rounding may hide this.
    constexpr double kRelativeTolerance = 1e-12;
    const auto cut_through = [&](double u) {
        return cracked_thickness(profile.half_thickness(u)) <=
               kRelativeTolerance * profile.root_half_thickness();
    };
    const bool passes_waist = lower_end_ >= profile.waist();
    broken_ = broken_ || cut_through(start_) || cut_through(lower_end_) ||
              (passes_waist && cut_through(profile.waist()));
    if (profile.lengthening_radius() > 0 && !broken_)
        lengthening_ = std::max(
            0.0, std::cos(crack.angle_rad) * std::min(crack.depth_m, max_depth - crack.depth_m) -
                     crack.height_m);
}

}  // namespace gearpod::stiffness
