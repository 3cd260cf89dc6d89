#include "stiffness/teeth/crack_compliance.hpp"

#include <cmath>

#include "stiffness/teeth/panels.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kDepthPoints = 12;
constexpr double kRounding = 1e-12;

}  // namespace

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
