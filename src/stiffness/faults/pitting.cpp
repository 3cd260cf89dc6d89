#include "stiffness/faults/pitting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stiffness/teeth/panels.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

constexpr int kPitPoints = 12;

// Roll angle at a distance along the profile from the base circle: the distance is R_b roll^2 / 2.
double roll_at(double base_radius, double arc) {
    return std::sqrt(2 * std::max(0.0, arc) / base_radius);
}

double arc_at(double base_radius, double radius) {
    return std::max(0.0, radius * radius / (base_radius * base_radius) - 1) * base_radius / 2;
}

double thickness_of(const ToothProfile& profile, double u) {
    return 2 * profile.half_thickness(u);
}

}  // namespace

class PittingFault : public ToothFault {
  public:
    PittingFault(const ToothPitting& family, double width_m)
        : family_(family), width_(std::min(width_m / family.material_.face_width_m, 1.0)) {}

    int teeth() const override { return family_.band_.teeth; }
    int gear() const override { return family_.which_; }
    bool changes_sections() const override { return family_.band_.depth_m > 0; }
    bool changes_contact() const override { return true; }
    std::vector<double> breaks() const override { return family_.jumps_; }
    std::vector<double> jumps() const override { return family_.jumps_; }

    FaceRange face() const override {
        return {std::max(0.0, family_.band_.face_centre - width_ / 2),
                std::min(1.0, family_.band_.face_centre + width_ / 2)};
    }

    double contact_width(double tau) const override {
        const double u = family_.angle_at(tau);
        return u <= family_.band_root_ && u >= family_.band_tip_ ? 1 - width_ : 1;
    }

    void beam_compliance(std::span<const double> tau, std::span<double> compliance) const override {
        family_.healthy_beam_(tau, compliance);
        SectionMoments lost;
        double u = family_.band_root_;
        const bool root_to_tip = family_.contact_rate_ < 0;
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const std::size_t next = root_to_tip ? i : tau.size() - 1 - i;
            const double contact = family_.angle_at(tau[next]);
            add_band(u, std::max(contact, family_.band_tip_), lost);
            compliance[next] += stiffness::compliance(lost, family_.profile_, family_.material_,
                                                      family_.profile_.involute_angle(contact));
        }
    }

  private:
    // Adds the changes of the moments by the sections between `from` and `to`, towards the tip, and
    // moves `from` to `to`.
    void add_band(double& from, double to, SectionMoments& lost) const {
        if (to >= from)
            return;
        const ToothProfile& profile = family_.profile_;
        for_panels(
            from, to, [&](double u) { return thickness_of(profile, u); },
            [&](double begin, double end) {
                for_gauss_points<kPitPoints>(begin, end, [&](double weight, double u) {
                    add_section(weight, profile.section(u), lost);
                });
            });
        from = to;
    }

    // Area and moment of inertia are per unit of face width.
    void add_section(double weight, const ToothSection& section, SectionMoments& lost) const {
        const double t = 2 * section.half_thickness, d = family_.band_.depth_m;
        const double area = t - width_ * d;
        const double arm = (t - d) / 2;
        const double inertia =
            t * t * t / 12 - width_ * d * d * d / 12 - width_ * d * (t / area) * arm * arm;
        const double x = section.axial - family_.profile_.root_axial();
        const double bending = weight * section.axial_slope * (1 / inertia - 12 / (t * t * t));
        const double direct = weight * section.axial_slope * (1 / area - 1 / t);
        lost.bending[0] += bending;
        lost.bending[1] += bending * x;
        lost.bending[2] += bending * x * x;
        lost.shear += direct;
        lost.axial += direct;
    }

    const ToothPitting& family_;
    double width_;  // fraction of the face width
};

ToothPitting::ToothPitting(const gears::MeshGeometry& geometry, const Material& material,
                           Profile profile, int which, const PitBand& band)
    : gear_(geometry.gear(which)),
      profile_(gear_, profile),
      material_(material),
      which_(which),
      band_(band),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which))),
      healthy_beam_(healthy_beam(geometry, material, profile_, 0, which)) {
    const double base = gear_.base_radius(), sense = gear_.internal ? 1 : -1;
    const double centre = arc_at(base, band.centre_radius_m);
    const auto angle = [&](double arc) {
        return gear_.half_base_angle() + sense * roll_at(base, arc);
    };
    const double ends[] = {angle(centre - band.length_m / 2), angle(centre + band.length_m / 2)};
    band_root_ = std::max(ends[0], ends[1]);
    band_tip_ = std::min(ends[0], ends[1]);
    for (const double u : ends) {
        const double tau = (u - contact_start_) / contact_rate_;
        if (tau > 0 && tau < geometry.contact_ratio())
            jumps_.push_back(tau);
    }
    std::sort(jumps_.begin(), jumps_.end());
}

std::unique_ptr<const ToothFault> ToothPitting::at(double width_m) const {
    return std::make_unique<PittingFault>(*this, width_m);
}

std::vector<std::string> ToothPitting::problems(double width_m) const {
    std::vector<std::string> all;
    if (width_m > material_.face_width_m)
        all.push_back(fmt::format("pits {:g} mm wide are wider than the face, {:g} mm",
                                  1e3 * width_m, 1e3 * material_.face_width_m));
    else if (const double centre_m = band_.face_centre * material_.face_width_m,
             reach = 0.5 * width_m, rounding = 1e-12 * material_.face_width_m;
             centre_m - reach < -rounding || centre_m + reach > material_.face_width_m + rounding)
        all.push_back(
            fmt::format("pits {:g} mm wide about {:g} mm from the end of the face reach beyond it, "
                        "0 to {:g} mm",
                        1e3 * width_m, 1e3 * centre_m, 1e3 * material_.face_width_m));
    const double base = gear_.base_radius();
    const double centre = arc_at(base, band_.centre_radius_m);
    const double foot = gear_.internal ? gear_.root_radius() : std::max(base, gear_.root_radius());
    const double low = arc_at(base, std::min(foot, gear_.tip_radius()));
    const double high = arc_at(base, std::max(foot, gear_.tip_radius()));
    if (!(band_.length_m > 0))
        all.push_back("pits need a length along the profile");
    else if (centre - band_.length_m / 2 < low || centre + band_.length_m / 2 > high)
        all.push_back(fmt::format(
            "pits {:g} mm long about the radius {:.4g} mm reach beyond the flank, {:.4g} to {:.4g} "
            "mm",
            1e3 * band_.length_m, 1e3 * band_.centre_radius_m,
            1e3 * std::min(foot, gear_.tip_radius()), 1e3 * std::max(foot, gear_.tip_radius())));
    else if (band_.depth_m >= thickness_of(profile_, band_tip_))
        all.push_back(fmt::format("pits {:g} mm deep go through the tooth, {:.3g} mm thick there",
                                  1e3 * band_.depth_m, 1e3 * thickness_of(profile_, band_tip_)));
    if (band_.teeth < 1 || band_.teeth > gear_.teeth - 3)
        all.push_back(
            fmt::format("{} pitted teeth of {} leave no healthy mesh between two passages",
                        band_.teeth, gear_.teeth));
    return all;
}

}  // namespace gearpod::stiffness
