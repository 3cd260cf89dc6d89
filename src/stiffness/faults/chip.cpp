#include "stiffness/faults/chip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearpod::stiffness {

class ChipFault : public ToothFault {
  public:
    ChipFault(const ToothChip& family, double length_m)
        : family_(family),
          length_(std::min(length_m, family.largest_size())),
          depth_(family.depth(length_)) {}

    int gear() const override { return family_.which_; }
    bool changes_contact() const override { return true; }

    double contact_width(double tau) const override {
        const double height = family_.height_;
        const double distance = std::min(family_.distance(tau), height);
        if (distance <= height - depth_)
            return 1;
        const double lost = length_ * height / depth_ * (1 - (height - depth_) / distance);
        return std::max(0.0, 1 - lost / family_.face_width_m_);
    }

    FaceRange face() const override {
        const double part = length_ / family_.face_width_m_;
        return family_.end_ == FaceEnd::first ? FaceRange{0, part} : FaceRange{1 - part, 1};
    }

    std::vector<double> breaks() const override {
        std::vector<double> taus{family_.position(family_.height_ - depth_),
                                 family_.position(family_.height_)};
        std::sort(taus.begin(), taus.end());
        return taus;
    }

  private:
    const ToothChip& family_;
    double length_, depth_;
};

ToothChip::ToothChip(const gears::MeshGeometry& geometry, double face_width_m, int which,
                     std::optional<double> depth_m, FaceEnd end)
    : profile_(geometry.gear(which), Profile::root_circle),
      face_width_m_(face_width_m),
      which_(which),
      depth_m_(depth_m),
      end_(end),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which))),
      foot_axial_(profile_.section(profile_.involute_root()).axial) {
    const gears::Gear& gear = geometry.gear(which);
    height_ = gear.internal ? gear.root_radius() - gear.tip_radius()
                            : gear.tip_radius() - std::max(gear.base_radius(), gear.root_radius());
}

double ToothChip::distance(double tau) const {
    return std::abs(profile_.section(contact_start_ + contact_rate_ * tau).axial - foot_axial_);
}

double ToothChip::position(double distance_m) const {
    const double axial = foot_axial_ + (profile_.internal() ? -distance_m : distance_m);
    return (profile_.angle_of_axial(axial) - contact_start_) / contact_rate_;
}

std::unique_ptr<const ToothFault> ToothChip::at(double length_m) const {
    return std::make_unique<ChipFault>(*this, length_m);
}

double ToothChip::largest_size() const {
    return depth_m_ ? face_width_m_ : std::min(face_width_m_, height_ / kDepthOverLength);
}

std::vector<std::string> ToothChip::problems(double length_m) const {
    std::vector<std::string> all;
    if (length_m > face_width_m_)
        all.push_back(fmt::format("a chip of {:g} mm is longer than the face, {:g} mm",
                                  1e3 * length_m, 1e3 * face_width_m_));
    if (depth(length_m) > height_)
        all.push_back(fmt::format(
            "a chip of {:g} mm is {:g} mm deep{}, deeper than the tooth's flank, {:.3g} mm",
            1e3 * length_m, 1e3 * depth(length_m), depth_m_ ? "" : " (a quarter of its length)",
            1e3 * height_));
    return all;
}

}  // namespace gearpod::stiffness
