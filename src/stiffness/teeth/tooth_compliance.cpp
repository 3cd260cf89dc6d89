#include "stiffness/teeth/tooth_compliance.hpp"

#include <cmath>
#include <limits>

#include "stiffness/teeth/panels.hpp"

namespace gearpod::stiffness {
namespace {

constexpr int kGaussPoints = 12;
// Half the points suffice on panels on which the thickness changes by less than kEven, because the
// pole of 1 / t^3 is far from them.
constexpr int kFewPoints = 6;
constexpr double kEven = 1.1;
constexpr double kShort_rad = 0.1;

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
            const ToothSection section = profile_->section(u);
            add_section(weight * section.axial_slope, section.axial,
                        thickness(section.half_thickness), 2 * section.half_thickness);
        };
        const double ratio = thickness_at(from) / thickness_at(until);
        if (ratio < kEven && 1 < kEven * ratio && std::abs(from - until) < kShort_rad)
            for_gauss_points<kFewPoints>(from, until, add);
        else
            for_gauss_points<kGaussPoints>(from, until, add);
    });
    u_ = to;
}

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

ChebyshevSeries healthy_beam(const gears::MeshGeometry& geometry, const Material& material,
                             const ToothProfile& profile, double tolerance, int which) {
    const auto compliance = [&](double tau) {
        return tooth_compliance(profile, material, geometry.contact_angle(which, tau)).total();
    };
    return {compliance, 0, geometry.contact_ratio(), kSeriesNodes,
            std::max(tolerance, kSeriesTolerance)};
}

}  // namespace gearpod::stiffness
