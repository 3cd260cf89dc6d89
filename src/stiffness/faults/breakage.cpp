#include "stiffness/faults/breakage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

class BreakageFault : public ToothFault {
  public:
    BreakageFault(const ToothBreakage& family, double width_m)
        : family_(family), width_(std::min(width_m / family.material_.face_width_m, 1.0)) {}

    int gear() const override { return family_.which_; }
    bool changes_sections() const override { return true; }
    bool changes_contact() const override { return true; }
    std::vector<double> breaks() const override { return family_.jumps_; }
    std::vector<double> jumps() const override { return family_.jumps_; }

    double contact_width(double tau) const override {
        return family_.angle_at(tau) < family_.plane_ ? 1 - width_ : 1;
    }

    FaceRange face() const override {
        return family_.end_ == FaceEnd::first ? FaceRange{0, width_} : FaceRange{1 - width_, 1};
    }

    void beam_compliance(std::span<const double> tau, std::span<double> compliance) const override {
        family_.healthy_beam_(tau, compliance);
        const ToothProfile& profile = family_.profile_;
        const CrackedSections whole(profile, {});
        SectionSweep sweep(profile, whole);
        sweep.advance(family_.plane_);
        const SectionMoments below = sweep.moments();
        const bool root_to_tip = family_.contact_rate_ < 0;
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const std::size_t next = root_to_tip ? i : tau.size() - 1 - i;
            const double u = family_.angle_at(tau[next]);
            if (u >= family_.plane_)
                continue;
            if (width_ == 1) {
                compliance[next] = std::numeric_limits<double>::infinity();
                continue;
            }
            sweep.advance(u);
            compliance[next] += width_ / (1 - width_) *
                                stiffness::compliance(difference(sweep.moments(), below), profile,
                                                      family_.material_, profile.involute_angle(u));
        }
    }

  private:
    static SectionMoments difference(SectionMoments moments, const SectionMoments& less) {
        for (std::size_t m = 0; m < 3; ++m)
            moments.bending[m] -= less.bending[m];
        moments.shear -= less.shear;
        moments.axial -= less.axial;
        return moments;
    }

    const ToothBreakage& family_;
    double width_;  // fraction of the face width
};

ToothBreakage::ToothBreakage(const gears::MeshGeometry& geometry, const Material& material,
                             Profile profile, int which, std::optional<double> height_m,
                             FaceEnd end)
    : profile_(geometry.gear(which), profile),
      material_(material),
      which_(which),
      end_(end),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which))),
      flank_height_(std::abs(geometry.gear(which).tip_radius() -
                             profile_.section(profile_.involute_root()).axial)),
      height_(height_m.value_or(flank_height_)),
      plane_(profile_.involute_root()),
      healthy_beam_(healthy_beam(geometry, material, profile_, 0, which)) {
    if (height_ < flank_height_)
        plane_ = profile_.angle_of_axial(geometry.gear(which).tip_radius() +
                                         (profile_.internal() ? height_ : -height_));
    const double tau = (plane_ - contact_start_) / contact_rate_;
    if (tau > 0 && tau < geometry.contact_ratio())
        jumps_.push_back(tau);
}

std::unique_ptr<const ToothFault> ToothBreakage::at(double width_m) const {
    return std::make_unique<BreakageFault>(*this, width_m);
}

std::vector<std::string> ToothBreakage::problems(double width_m) const {
    constexpr double kRounding = 1 + 1e-12;
    std::vector<std::string> all;
    if (width_m > material_.face_width_m * kRounding)
        all.push_back(fmt::format("a breakage {:g} mm wide is wider than the face, {:g} mm",
                                  1e3 * width_m, 1e3 * material_.face_width_m));
    if (height_ > flank_height_ * kRounding)
        all.push_back(fmt::format("a breakage {:g} mm high reaches below the flank, {:.4g} mm high",
                                  1e3 * height_, 1e3 * flank_height_));
    return all;
}

}  // namespace gearpod::stiffness
