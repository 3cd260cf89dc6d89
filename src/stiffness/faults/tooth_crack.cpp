#include "stiffness/faults/tooth_crack.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

class CrackFault : public ToothFault {
  public:
    CrackFault(const ToothCrack& family, double depth_m)
        : family_(family),
          sections_(family.profile_, family.law_ == CrackLaw::sections
                                         ? Crack{depth_m, family.crack_angle_rad_}
                                         : Crack{}) {
        if (family.law_ == CrackLaw::fracture_mechanics)
            added_.emplace(CrackPath(family.profile_, family.crack_angle_rad_), family.material_,
                           depth_m);
    }

    int gear() const override { return family_.which_; }
    bool changes_sections() const override { return true; }

    void beam_compliance(std::span<const double> tau, std::span<double> compliance) const override {
        if (sections_.broken() || (added_ && added_->broken())) {
            std::fill(compliance.begin(), compliance.end(), kInfinity);
            return;
        }
        SectionSweep sweep(family_.profile_, sections_);
        const bool root_to_tip = family_.contact_rate_ < 0;
        for (std::size_t i = 0; i < tau.size(); ++i) {
            const std::size_t next = root_to_tip ? i : tau.size() - 1 - i;
            compliance[next] = touched_at(family_.angle_at(tau[next]), sweep);
        }
    }

    // Position at which the section law changes.
    std::vector<double> breaks() const override {
        if (!sections_.cracked() || sections_.broken())
            return {};
        const double tau = (sections_.boundary() - family_.contact_start_) / family_.contact_rate_;
        if (tau <= 0 || tau >= family_.contact_ratio_)
            return {};
        return {tau};
    }

  private:
    double touched_at(double u, SectionSweep& sweep) const {
        if (sections_.unsupported(u))
            return kInfinity;
        sweep.advance(u);
        const double angle = family_.profile_.involute_angle(u);
        const double beam =
            stiffness::compliance(sweep.moments(), family_.profile_, family_.material_, angle);
        return added_ ? beam + added_->added(angle) : beam;
    }

    const ToothCrack& family_;
    CrackedSections sections_;              // without a crack under fracture mechanics
    std::optional<CrackCompliance> added_;  // by fracture mechanics
};

ToothCrack::ToothCrack(const gears::MeshGeometry& geometry, const Material& material,
                       Profile profile, int which, double crack_angle_rad, CrackLaw law)
    : profile_(geometry.gear(which == 2 ? 2 : 1), profile),
      material_(material),
      which_(which),
      crack_angle_rad_(crack_angle_rad),
      law_(law),
      contact_ratio_(geometry.contact_ratio()),
      contact_start_(profile_.involute_angle(geometry.contact_angle_at_start(which == 2 ? 2 : 1))),
      contact_rate_(profile_.involute_angle(geometry.contact_angle_rate(which == 2 ? 2 : 1))) {
    if (which != 1 && which != 2)
        throw std::invalid_argument("the cracked gear of a pair is gear 1 or gear 2");
    if (!(crack_angle_rad > 0 && crack_angle_rad < std::numbers::pi / 2))
        throw std::invalid_argument(
            "the crack's angle to the tooth's centre line must lie between 0 and 90 degrees");
}

double ToothCrack::largest_size() const {
    return max_crack_depth(profile_, law_, crack_angle_rad_);
}

std::unique_ptr<const ToothFault> ToothCrack::at(double depth_m) const {
    return std::make_unique<CrackFault>(*this, depth_m);
}

}  // namespace gearpod::stiffness
