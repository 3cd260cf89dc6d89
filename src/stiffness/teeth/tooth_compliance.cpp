#include "stiffness/teeth/tooth_compliance.hpp"

#include <cmath>
#include <limits>

#include "stiffness/teeth/panels.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kTipPoints = 20;

template <typename Integrand, typename Thickness>
double integrate(double from, double to, Integrand&& integrand, Thickness&& thickness) {
    double sum = 0;
    if (from < to)
        for_panels(from, to, thickness, [&](double a, double b) {
            for_gauss_points<kTipPoints>(
                a, b, [&](double weight, double p) { sum += weight * integrand(p); });
        });
    return sum;
}

// Integrals over one stretch of the beam with the parameter p: axial(p), slope(p) = |dxi/dp|,
// thickness(p).
class BeamIntegrals {
  public:
    BeamIntegrals(const ToothProfile& profile, const Material& material, double contact_angle)
        : base_radius_(profile.base_radius()),
          cosine_(std::cos(contact_angle)),
          sine_(std::sin(contact_angle)),
          stretch_(material.youngs_modulus_Pa * material.face_width_m),
          bend_(material.bending_factor * stretch_),
          shear_(material.shear_factor * stretch_ / (2 * (1 + material.poisson_ratio))),
          shear_energy_(material.shear_energy) {}

    template <typename Axial, typename Slope, typename Thickness>
    void add_bending_and_shear(double from, double to, Axial axial, Slope slope,
                               Thickness thickness) {
        const auto bending = [&](double p) {
            const double arm = base_radius_ - axial(p) * cosine_;
            const double t = thickness(p);
            return 12 * arm * arm * slope(p) / (bend_ * t * t * t);
        };
        const auto shear = [&](double p) {
            return 1.2 * cosine_ * cosine_ * slope(p) / (shear_ * thickness(p));
        };
        sum_.bending += integrate(from, to, bending, thickness);
        if (shear_energy_)
            sum_.shear += integrate(from, to, shear, thickness);
    }

    template <typename Slope, typename Thickness>
    void add_axial(double from, double to, Slope slope, Thickness healthy_thickness) {
        const auto axial = [&](double p) {
            return sine_ * sine_ * slope(p) / (stretch_ * healthy_thickness(p));
        };
        sum_.axial += integrate(from, to, axial, healthy_thickness);
    }

    const ToothCompliance& sum() const { return sum_; }

  private:
    double base_radius_, cosine_, sine_;
    double stretch_, bend_, shear_;  // E L, G L, with the helix
    bool shear_energy_;
    ToothCompliance sum_;
};

}  // namespace

ToothCompliance tooth_compliance(const ToothProfile& profile, const Material& material,
                                 double contact_angle, const Crack& crack) {
    const double contact = profile.involute_angle(contact_angle);
    CrackedSections sections(profile, crack);
    if (sections.unsupported(contact)) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        return {kInfinity, kInfinity, kInfinity};
    }
    if (!sections.affects(contact))
        sections = CrackedSections(profile, {});

    BeamIntegrals beam(profile, material, contact_angle);
    const auto axial = [&](double u) { return profile.section(u).axial; };
    const auto slope = [&](double u) { return profile.section(u).axial_slope; };
    const auto healthy = [&](double u) { return 2 * profile.half_thickness(u); };
    const auto cracked = [&](double u) {
        return sections.cracked_thickness(profile.half_thickness(u));
    };
    const double root = profile.root_axial(), radius = profile.lengthening_radius();
    beam.add_bending_and_shear(
        root - sections.lengthening(), root, [](double xi) { return xi; },
        [](double) { return 1.0; },
        [&](double xi) {
            return sections.cracked_thickness(std::sqrt(radius * radius - xi * xi));
        });
    for_section_parts(profile, sections, profile.root(), contact,
                      [&](double from, double until, bool is_cracked) {
                          if (is_cracked)
                              beam.add_bending_and_shear(until, from, axial, slope, cracked);
                          else
                              beam.add_bending_and_shear(until, from, axial, slope, healthy);
                          beam.add_axial(until, from, slope, healthy);
                      });
    return beam.sum();
}

}  // namespace gearpod::stiffness
