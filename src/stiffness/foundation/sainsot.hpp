// Foundation compliance of Sainsot, Velex and Duverger (2004): a fit to the elastic ring for
// external gears fixed at the bore,
//
//     1/k_f = cos^2 a / (E L) [L (u/S)^2 + M (u/S) + P (1 + Q tan^2 a)],
//
// with a the contact angle and S the width of the tooth's root. u is the distance from the root
// circle to the intersection of the line of action and the tooth's centre line. Yang (2022), Eq.
// 20. The formula has no coupling between teeth.
#pragma once

#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

// Coefficients L*, M*, P*, Q*.
struct SainsotCoefficients {
    double L = 0, M = 0, P = 0, Q = 0;
};
// root_half_angle: rad; radii: root over bore radius.
SainsotCoefficients sainsot_coefficients(double root_half_angle, double radii);

class SainsotFoundation : public FilletFoundation {
  public:
    // Range of the fit.
    static constexpr double kAngleMin = 0.01, kAngleMax = 0.12;  // rad
    static constexpr double kRadiiMin = 1.4, kRadiiMax = 7;

    SainsotFoundation(const ToothProfile& tooth, const Material& material, double bore_radius_m);

    FoundationCompliance self(double contact_angle) const override;
    double coupling(double, double, int) const override { return 0; }

  private:
    double base_radius_, root_radius_, root_width_;
    double stretch_;  // E L
    SainsotCoefficients coefficients_;
};

}  // namespace gearpod::stiffness
