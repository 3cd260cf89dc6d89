#include "stiffness/teeth/fracture_mechanics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/panels.hpp"

namespace gearpod::stiffness {
namespace {

using Coefficients = std::array<double, 7>;
constexpr Coefficients kTension{1.1214, -1.5743, 6.3317, -13.043, 15.883, -10.388, 2.7895};
constexpr Coefficients kBending{1.1214, -2.9181, 7.905, -15.893, 19.67, -13.025, 3.5138};

double with_ligament(const Coefficients& coefficients, double share) {
    double sum = 0.0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) {
        sum = sum * share + *c;
    }
    return sum / std::pow(1.0 - share, 1.5);
}

// Factors on the strip's bending stress, for cracks at the surface and for deep cracks. kFading is
// the fraction of the crack's whole length over which the surface value fades. Calibrated
// as CrackPath states.
struct ToothFactors {
    double surface_moment, surface_lever, deep_lever;
};
constexpr ToothFactors kFillet{1.10, 0.38, -0.045}, kCorner{1.65, 0.27, -0.11};
constexpr double kDeepMoment = 0.88, kFading = 0.087;

constexpr int kDepthPoints = 12;
constexpr double kRounding = 1e-12;

}  // namespace

double edge_crack_tension(double share) {
    return with_ligament(kTension, share);
}

double edge_crack_bending(double share) {
    return with_ligament(kBending, share);
}

double edge_crack_shear(double share) {
    return (1.122 + share * (-0.561 + share * (0.085 + share * 0.180))) / std::sqrt(1.0 - share);
}

CrackPath::CrackPath(const ToothProfile& profile, double angle_rad, double height_m)
    : cosine_(std::cos(angle_rad)),
      sine_(std::sin(angle_rad)),
      sense_(profile.internal() ? -1 : 1),
      base_radius_(profile.base_radius()),
      fillet_(profile.fillet_radius() > 0),
      start_(profile.critical()) {
    if (height_m > 0)
        start_ = profile.angle_of_axial(profile.section(start_).axial + sense_ * height_m);
    const ToothSection section = profile.section(start_);
    axial_ = section.axial;
    half_thickness_ = section.half_thickness;
}

// The tip lies `down` below the start's section. The path ends at the height of the start on the
// other flank.
CrackPath::Vector CrackPath::tip_to_end(double depth_m) const {
    const double down = std::min(depth_m, length() - depth_m) * cosine_;
    return {down, depth_m * sine_ - 2 * half_thickness_};
}

double CrackPath::ligament(double depth_m) const {
    const Vector across = tip_to_end(depth_m);
    return std::hypot(across.x, across.y);
}

// The force of 1 N acts along -(sin a, cos a). Its moment about the centre of the start's section
// is R_b - xi cos a, with the opposite sign for internal teeth (tooth_compliance.hpp).
CrackIntensity CrackPath::intensity(double depth_m) const {
    const Vector across = tip_to_end(depth_m);
    const double ligament = std::hypot(across.x, across.y), width = depth_m + ligament;
    const Vector along{across.x / ligament, across.y / ligament};
    const Vector middle{-along.x * width / 2, -half_thickness_ - along.y * width / 2};
    const double share = depth_m / width, root = std::sqrt(std::numbers::pi * depth_m);
    double tension = edge_crack_tension(share) * root / width;
    double bending = 6 * edge_crack_bending(share) * root / (width * width);
    const double shear = edge_crack_shear(share) * root / width;

    const ToothFactors& of = fillet_ ? kFillet : kCorner;
    const double surface = std::exp(-depth_m / (kFading * length()));
    const double lever =
        bending * width * (of.deep_lever + (of.surface_lever - of.deep_lever) * surface);
    const double moment = kDeepMoment + (of.surface_moment - kDeepMoment) * surface;
    tension *= moment;
    bending *= moment;
    CrackIntensity k;
    k.constant = bending * sense_ * base_radius_;
    k.cosine = bending * (-sense_ * axial_ - middle.x) - tension * along.x - lever * along.y;
    k.sine = bending * middle.y + tension * along.y - lever * along.x;
    k.sliding_cosine = -shear * along.y;
    k.sliding_sine = -shear * along.x;
    return k;
}

double max_crack_depth(const ToothProfile& profile, CrackLaw law, double angle_rad) {
    return law == CrackLaw::fracture_mechanics ? CrackPath(profile, angle_rad).length()
                                               : max_crack_depth(profile, angle_rad);
}

CrackCompliance::CrackCompliance(const CrackPath& path, const Material& material, double depth_m)
    : broken_(depth_m >= path.length() * (1 - kRounding)) {
    if (broken_)
        return;
    const double scale = 2 * (1 - material.poisson_ratio * material.poisson_ratio) /
                         (material.youngs_modulus_Pa * material.face_width_m);
    const auto ligament = [&](double depth) { return path.ligament(depth); };
    const auto add_panel = [&](double from, double to) {
        for_gauss_points<kDepthPoints>(from, to, [&](double weight, double depth) {
            points_.push_back({scale * weight / material.bending_factor,
                               scale * weight / material.shear_factor, path.intensity(depth)});
        });
    };
    const double turn = std::min(depth_m, path.turn());
    for_panels(0.0, turn, ligament, add_panel);
    for_panels(turn, depth_m, ligament, add_panel);
}

double CrackCompliance::added(double contact_angle) const {
    const double cosine = std::cos(contact_angle), sine = std::sin(contact_angle);
    double sum = 0;
    for (const Point& point : points_) {
        const double opening = point.intensity.opening(cosine, sine);
        const double sliding = point.intensity.sliding(cosine, sine);
        sum += point.opening_weight * opening * opening + point.sliding_weight * sliding * sliding;
    }
    return sum;
}

}  // namespace gearpod::stiffness
