#include "stiffness/foundation/foundation_models.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "stiffness/foundation/elastic_ring.hpp"

namespace gearpod::stiffness {

SainsotCoefficients sainsot_coefficients(double root_half_angle, double radii) {
    const auto fit = [t = root_half_angle, h = radii](double a, double b, double c, double d,
                                                      double e, double f) {
        return a / (t * t) + b * h * h + c * h / t + d / t + e * h + f;
    };
    return {fit(-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045),
            fit(60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086),
            fit(-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236),
            fit(-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904)};
}

SainsotFoundation::SainsotFoundation(const ToothProfile& tooth, const Material& material,
                                     double bore_radius_m)
    : base_radius_(tooth.base_radius()),
      root_radius_(tooth.root_radius()),
      root_width_(2 * root_radius_ * tooth.root_half_angle()),
      stretch_(material.youngs_modulus_Pa * material.face_width_m),
      coefficients_(sainsot_coefficients(tooth.root_half_angle(), root_radius_ / bore_radius_m)) {}

FoundationCompliance SainsotFoundation::self(double contact_angle) const {
    const double cosine = std::cos(contact_angle), tangent = std::tan(contact_angle);
    const double lever = (base_radius_ / cosine - root_radius_) / root_width_;
    const double unit = cosine * cosine / stretch_;
    const auto& [L, M, P, Q] = coefficients_;
    return {unit * L * lever * lever, unit * M * lever, unit * P * (1 + Q * tangent * tangent)};
}

namespace {

bool has_foundation(const gears::Gear& gear, FoundationModel model) {
    return model == FoundationModel::elastic_ring ||
           (model == FoundationModel::sainsot && !gear.internal);
}

}  // namespace

std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m) {
    if (model != FoundationModel::sainsot || gear.internal || !(body_radius_m > 0))
        return {};
    const ToothProfile tooth(gear, profile);
    std::vector<std::string> warnings;
    const auto check = [&](const char* what, double value, double low, double high) {
        if (value < low || value > high)
            warnings.push_back(
                fmt::format("{} of {} teeth is {:.3g}; Sainsot's formula is fitted "
                            "from {} to {} (use the elastic ring)",
                            what, gear.teeth, value, low, high));
    };
    check("half the angle of the root of one", tooth.root_half_angle(),
          SainsotFoundation::kAngleMin, SainsotFoundation::kAngleMax);
    check("root radius over bore radius", tooth.root_radius() / body_radius_m,
          SainsotFoundation::kRadiiMin, SainsotFoundation::kRadiiMax);
    return warnings;
}

std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m) {
    if (!has_foundation(gear, model))
        return nullptr;
    const ToothProfile tooth(gear, profile);
    const double root = tooth.root_radius();
    if (gear.internal ? !(body_radius_m > root) : !(body_radius_m > 0 && body_radius_m < root))
        throw std::invalid_argument(fmt::format(
            "the body of {} teeth is held at a radius of {} m, which is not {} its root circle of "
            "{:.5g} m",
            gear.teeth, body_radius_m, gear.internal ? "outside" : "inside", root));
    if (model == FoundationModel::sainsot)
        return std::make_unique<SainsotFoundation>(tooth, material, body_radius_m);
    return std::make_unique<ElasticRing>(tooth, gear.teeth, material, body_radius_m);
}

}  // namespace gearpod::stiffness
