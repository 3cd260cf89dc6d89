#include "stiffness/growth/crack_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

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
    constexpr int kTouchPoints = 200;
    const double ratio = geometry.contact_ratio();
    for (int i = 0; i <= kTouchPoints; ++i) {
        const double tau = ratio * i / kTouchPoints;
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

namespace {

constexpr int kPanels = 64;
// Gauss-Legendre rule of five points on [-1, 1].
constexpr std::array<double, 5> kNodes{-0.906179845938664, -0.5384693101056831, 0.0,
                                       0.5384693101056831, 0.906179845938664};
constexpr std::array<double, 5> kWeights{0.23692688505618908, 0.47862867049936647,
                                         0.5688888888888889, 0.47862867049936647,
                                         0.23692688505618908};

}  // namespace

ParisLaw paris_law_mm_MPa(double factor, double exponent) {
    return {1e-3 * factor * std::pow(1e-6, exponent), exponent};
}

ParisGrowth::ParisGrowth(const ParisLaw& law, std::function<double(double)> range, double first,
                         double last)
    : law_(law), range_(std::move(range)) {
    if (!(first > 0.0 && last > first && law.factor > 0.0)) {
        throw std::invalid_argument("crack growth: needs 0 < first depth < last depth and C > 0");
    }
    for (int i = 0; i <= kPanels; ++i) {
        depth_.push_back(first * std::pow(last / first, static_cast<double>(i) / kPanels));
        if (!(range_(depth_.back()) > 0.0)) {
            throw std::invalid_argument("crack growth: the load does not open the crack");
        }
        damage_.push_back(i == 0 ? 0.0 : damage_.back() + between(depth_[i - 1U], depth_.back()));
    }
}

double ParisGrowth::rate_inverse(double depth) const {
    return 1.0 / (law_.factor * std::pow(range_(depth), law_.exponent));
}

double ParisGrowth::between(double from, double to) const {
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        sum += kWeights[i] * rate_inverse(middle + half * kNodes[i]);
    }
    return half * sum;
}

double ParisGrowth::damage_to(double depth) const {
    const double a = std::clamp(depth, depth_.front(), depth_.back());
    const auto next = std::upper_bound(depth_.begin() + 1, depth_.end() - 1, a);
    const auto panel = static_cast<std::size_t>(next - depth_.begin()) - 1;
    return damage_[panel] + between(depth_[panel], a);
}

double ParisGrowth::depth_after(double damage) const {
    if (std::isnan(damage)) {
        return damage;
    }
    if (damage <= 0.0) {
        return depth_.front();
    }
    if (damage >= damage_.back()) {
        return depth_.back();
    }
    const auto next = std::upper_bound(damage_.begin(), damage_.end(), damage);
    const auto panel = static_cast<std::size_t>(next - damage_.begin()) - 1;
    const double remaining_damage = damage - damage_[panel];
    double low = depth_[panel], high = depth_[panel + 1];
    double a = low + (high - low) * remaining_damage / (damage_[panel + 1] - damage_[panel]);
    // Newton's method, with bisection where a step leaves the bracket.
    constexpr int kSteps = 60;
    for (int step = 0; step < kSteps; ++step) {
        const double miss = between(depth_[panel], a) - remaining_damage;
        (miss > 0.0 ? high : low) = a;
        const double newton = a - miss / rate_inverse(a);
        const double better = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(better - a) <= 1e-14 * a) {
            return better;
        }
        a = better;
    }
    return a;
}

double ParisGrowth::damage_of(double load, double cycles) const {
    return cycles * std::pow(load, law_.exponent);
}

}  // namespace gearpod::stiffness
