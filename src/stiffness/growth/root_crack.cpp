#include "stiffness/growth/root_crack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stiffness/growth/edge_crack.hpp"

namespace gearpod::stiffness {

RootCrack::RootCrack(const gears::MeshGeometry& geometry, Profile profile, int which,
                     double crack_angle_rad, double face_width_m)
    : geometry_(geometry),
      profile_(geometry.gear(which), profile),
      which_(which),
      angle_(crack_angle_rad),
      face_width_(face_width_m),
      width_(2.0 * profile_.root_half_thickness() / std::sin(crack_angle_rad)) {
    if (!(crack_angle_rad > 0.0 && crack_angle_rad <= std::numbers::pi / 2)) {
        throw std::invalid_argument(
            "the crack's angle to the tooth's centre line must lie between 0 and 90 degrees");
    }
    constexpr int kPositions = 200;
    const double ratio = geometry.contact_ratio();
    for (int i = 0; i <= kPositions; ++i) {
        const double tau = ratio * i / kPositions;
        // Pairs that touch at once: those a whole number of mesh periods before and behind.
        const double pairs = 1.0 + std::floor(tau) + std::floor(ratio - tau);
        const Stress stress = stress_at(tau);
        engagement_.push_back({stress.tension / pairs, stress.bending / pairs});
    }
}

// x along the centre line to the tip, from the root section; y to the loaded flank. The crack runs
// along -(cos v, sin v) from (0, h_root), so its plane's middle is (-h_root / tan v, 0) and its
// normal on the tip's side (sin v, -cos v). The flank at y = h_x is pushed by 1 N along -(sin a,
// cos a).
RootCrack::Stress RootCrack::stress_at(double tau) const {
    const double a = geometry_.contact_angle(which_, tau);
    const ToothSection contact = profile_.section(profile_.involute_angle(a));
    const double x = std::abs(contact.axial - profile_.root_axial());
    const double middle = -profile_.root_half_thickness() / std::tan(angle_);
    const double across = std::cos(a) * std::cos(angle_) - std::sin(a) * std::sin(angle_);
    const double moment = (x - middle) * std::cos(a) - contact.half_thickness * std::sin(a);
    const double area = face_width_ * width_;
    return {across / area, 6.0 * moment / (area * width_)};
}

double RootCrack::intensity_of(const Stress& stress, double depth_m, double share) {
    const double opening =
        stress.tension * edge_crack_tension(share) + stress.bending * edge_crack_bending(share);
    return std::max(0.0, opening * std::sqrt(std::numbers::pi * depth_m));
}

double RootCrack::intensity(double depth_m, double force_N, double tau) const {
    return force_N * intensity_of(stress_at(tau), depth_m, depth_m / width_);
}

double RootCrack::largest_intensity(double depth_m, double force_N) const {
    const double share = depth_m / width_;
    const double tension = edge_crack_tension(share), bending = edge_crack_bending(share);
    double largest = 0.0;
    for (const Stress& stress : engagement_) {
        largest = std::max(largest, stress.tension * tension + stress.bending * bending);
    }
    return force_N * largest * std::sqrt(std::numbers::pi * depth_m);
}

}  // namespace gearpod::stiffness
