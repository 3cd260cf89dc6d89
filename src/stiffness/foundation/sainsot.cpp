#include "stiffness/foundation/sainsot.hpp"

#include <cmath>

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

}  // namespace gearpod::stiffness
