#include "stiffness/teeth/section_moments.hpp"

#include <cmath>

#include "stiffness/teeth/panels.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kGaussPoints = 12;
// Half the points suffice on panels on which the thickness changes by less than kEven, because the
// pole of 1 / t^3 is far from them.
constexpr int kFewPoints = 6;
constexpr double kEven = 1.1;
constexpr double kShort_rad = 0.1;

}  // namespace

double bending_compliance(const SectionMoments& m, const ToothProfile& profile,
                          const Material& material, double cosine) {
    const double root_arm = profile.base_radius() - profile.root_axial() * cosine;
    return (root_arm * (root_arm * m.bending[0] - 2 * cosine * m.bending[1]) +
            cosine * cosine * m.bending[2]) /
           (material.bending_factor * material.youngs_modulus_Pa * material.face_width_m);
}

double shear_compliance(const SectionMoments& m, const Material& material, double cosine) {
    return material.shear_energy
               ? 2.4 * (1 + material.poisson_ratio) * cosine * cosine * m.shear /
                     (material.shear_factor * material.youngs_modulus_Pa * material.face_width_m)
               : 0;
}

double axial_compliance(const SectionMoments& m, const Material& material, double sine) {
    return sine * sine * m.axial / (material.youngs_modulus_Pa * material.face_width_m);
}

double compliance(const SectionMoments& m, const ToothProfile& profile, const Material& material,
                  double contact_angle) {
    const double cosine = std::cos(contact_angle), sine = std::sin(contact_angle);
    return bending_compliance(m, profile, material, cosine) +
           shear_compliance(m, material, cosine) + axial_compliance(m, material, sine);
}

SectionSweep::SectionSweep(const ToothProfile& profile, const CrackedSections& sections)
    : profile_(&profile), sections_(&sections), u_(profile.root()) {
    if (sections.broken())
        return;
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
        for_gauss_points<kGaussPoints>(
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
    const auto thickness_at = [&](double u) { return thickness(profile_->half_thickness(u)); };
    for_panels(u_, to, thickness_at, [&](double from, double until) {
        const auto add = [&](double weight, double u) {
            const ToothSection at = profile_->section(u);
            add_section(weight * at.axial_slope, at.axial, thickness(at.half_thickness),
                        2 * at.half_thickness);
        };
        const double ratio = thickness_at(from) / thickness_at(until);
        if (ratio < kEven && 1 < kEven * ratio && std::abs(from - until) < kShort_rad)
            for_gauss_points<kFewPoints>(from, until, add);
        else
            for_gauss_points<kGaussPoints>(from, until, add);
    });
    u_ = to;
}

}  // namespace gearpod::stiffness
