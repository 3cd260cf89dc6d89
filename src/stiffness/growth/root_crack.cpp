#include "stiffness/growth/root_crack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stiffness/teeth/edge_crack.hpp"

namespace gearpod::stiffness {

RootCrack::RootCrack(const gears::MeshGeometry& geometry, Profile profile, int which,
                     double crack_angle_rad, double face_width_m, CrackLaw law)
    : geometry_(geometry),
      profile_(geometry.gear(which), profile),
      which_(which),
      angle_(crack_angle_rad),
      face_width_(face_width_m),
      law_(law),
      path_(profile_, crack_angle_rad),
      width_(law == CrackLaw::fracture_mechanics
                 ? path_.length()
                 : 2.0 * profile_.root_half_thickness() / std::sin(crack_angle_rad)) {
    if (!(crack_angle_rad > 0.0 && crack_angle_rad <= std::numbers::pi / 2)) {
        throw std::invalid_argument(
            "the crack's angle to the tooth's centre line must lie between 0 and 90 degrees");
    }
    constexpr int kPositions = 200;
    const double ratio = geometry.contact_ratio();
    for (int i = 0; i <= kPositions; ++i) {
        const double tau = ratio * i / kPositions;
        // Pairs in contact at the same time are a whole number of mesh periods before and after.
        const double pairs = 1.0 + std::floor(tau) + std::floor(ratio - tau);
        ContactPoint touch = touch_at(tau);
        touch.share = 1.0 / pairs;
        touch.stress = {touch.stress.tension / pairs, touch.stress.bending / pairs};
        engagement_.push_back(touch);
    }
}

// x runs along the centre line from the root section to the tip, y to the loaded flank. The crack
// runs along -(cos v, sin v) from (0, h_root). The middle of its plane is therefore (-h_root / tan
// v, 0), and its normal on the tip's side (sin v, -cos v). A force of 1 N pushes the flank at y =
// h_x along -(sin a, cos a).
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

RootCrack::ContactPoint RootCrack::touch_at(double tau) const {
    const double a = geometry_.contact_angle(which_, tau);
    return {std::cos(a), std::sin(a), 1.0, stress_at(tau)};
}

double RootCrack::largest_opening(double depth_m, std::span<const ContactPoint> touches) const {
    if (!(depth_m > 0.0)) {
        return 0.0;
    }
    double largest = 0.0;
    if (law_ == CrackLaw::fracture_mechanics) {
        const CrackIntensity k = path_.intensity(depth_m);
        for (const ContactPoint& touch : touches) {
            largest = std::max(largest, touch.share * k.opening(touch.cosine, touch.sine));
        }
        return largest / face_width_;
    }
    const double share = depth_m / width_;
    const double tension = edge_crack_tension(share), bending = edge_crack_bending(share);
    for (const ContactPoint& touch : touches) {
        largest =
            std::max(largest, touch.stress.tension * tension + touch.stress.bending * bending);
    }
    return largest * std::sqrt(std::numbers::pi * depth_m);
}

double RootCrack::intensity(double depth_m, double force_N, double tau) const {
    const ContactPoint touch = touch_at(tau);
    return force_N * largest_opening(depth_m, {&touch, 1});
}

double RootCrack::largest_intensity(double depth_m, double force_N) const {
    return force_N * largest_opening(depth_m, engagement_);
}

}  // namespace gearpod::stiffness
