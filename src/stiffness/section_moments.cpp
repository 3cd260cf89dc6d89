#include "stiffness/section_moments.hpp"

#include <cmath>

#include "stiffness/panels.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kPoints = 12;

}  // namespace

double compliance(const SectionMoments& m, const ToothProfile& profile, const Material& material,
                  double contact_angle) {
    const double c = std::cos(contact_angle), s = std::sin(contact_angle);
    const double root_arm = profile.base_radius() - profile.root_axial() * c;
    const double bending =
        root_arm * (root_arm * m.bending[0] - 2 * c * m.bending[1]) + c * c * m.bending[2];
    const double shear =
        material.shear_energy ? 2.4 * (1 + material.poisson_ratio) * c * c * m.shear : 0;
    return (bending + shear + s * s * m.axial) /
           (material.youngs_modulus_Pa * material.face_width_m);
}

SectionSweep::SectionSweep(const ToothProfile& profile, const CrackedSections& sections)
    : profile_(&profile), sections_(&sections), u_(profile.root()) {
    add_lengthening();
    advance(profile.involute_root());
}

void SectionSweep::add_section(double weight, double axial, double thickness,
                               double healthy_thickness) {
    const double x = axial - profile_->root_axial();
    const double bending = 12 * weight / (thickness * thickness * thickness);
    moments_.bending[0] += bending;
    moments_.bending[1] += bending * x;
    moments_.bending[2] += bending * x * x;
    moments_.shear += weight / thickness;
    moments_.axial += weight / healthy_thickness;
}

void SectionSweep::add_lengthening() {
    const double length = sections_->lengthening();
    if (length <= 0)
        return;
    const double radius = profile_->lengthening_radius(), root = profile_->root_axial();
    const auto thickness = [&](double xi) {
        return sections_->cracked_thickness(std::sqrt(radius * radius - xi * xi));
    };
    const double axial = moments_.axial;
    for_panels(root, root - length, thickness, [&](double from, double to) {
        for_gauss_points<kPoints>(
            from, to, [&](double weight, double xi) { add_section(weight, xi, thickness(xi), 1); });
    });
    moments_.axial = axial;
}

void SectionSweep::advance(double to) {
    for_section_parts(*profile_, *sections_, u_, to,
                      [&](double, double until, bool cracked) { advance(until, cracked); });
}

void SectionSweep::advance(double to, bool cracked) {
    if (to >= u_)
        return;
    const auto thickness = [&](double h) {
        return cracked ? sections_->cracked_thickness(h) : 2 * h;
    };
    for_panels(
        u_, to, [&](double u) { return thickness(profile_->half_thickness(u)); },
        [&](double from, double until) {
            for_gauss_points<kPoints>(from, until, [&](double weight, double u) {
                const ToothSection at = profile_->section(u);
                add_section(weight * at.axial_slope, at.axial, thickness(at.half_thickness),
                            2 * at.half_thickness);
            });
        });
    u_ = to;
}

}  // namespace gearpod::stiffness
