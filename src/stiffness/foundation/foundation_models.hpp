// Models of the gear body's compliance.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gears/gear.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

// Foundation compliance of Sainsot, Velex and Duverger (2004): a fit to the elastic ring for
// external gears fixed at the bore,
//
//     1/k_f = cos^2 a / (E L) [L (u/S)^2 + M (u/S) + P (1 + Q tan^2 a)],
//
// with a the contact angle and S the width of the tooth's root. u is the distance from the root
// circle to the intersection of the line of action and the tooth's centre line. Yang (2022), Eq.
// 20. The formula has no coupling between teeth.

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

// Selection of the foundation model of one gear.

// Warnings, one sentence each, if the root's half angle or the ratio of root and fixed radius lies
// outside the range of the model's fit; empty otherwise.
std::vector<std::string> foundation_warnings(const gears::Gear& gear, Profile profile,
                                             FoundationModel model, double body_radius_m);

// Foundation of one gear. body_radius_m: radius of the circle on which the gear body is fixed, the
// bore of an external gear or the outer circle of an internal one. Null for FoundationModel::none,
// and for an internal gear under Sainsot's formula, which is fitted to external gears. Throws
// std::invalid_argument if the circle does not lie within the body (external: inside the root
// circle; internal: outside it).
std::unique_ptr<const FilletFoundation> make_foundation(const gears::Gear& gear,
                                                        const Material& material, Profile profile,
                                                        FoundationModel model,
                                                        double body_radius_m);

}  // namespace gearpod::stiffness
