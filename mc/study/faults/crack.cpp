// Crack from the tooth root straight through the face width: stiffness/faults/tooth_crack.hpp.
#include "mc/study/faults/crack_angle.hpp"
#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/faults/tooth_crack.hpp"

namespace gearpod::mc {
namespace {

struct Crack : FaultShape {
    std::optional<double> depth_m;  // along the crack

    bool operator==(const Crack&) const = default;
};

// clang-format off
constexpr FaultSize kCrackSize{"depth_mm", number<&Crack::depth_m>, kMm, kNotNegative, "depth along the crack"};
constexpr FaultKey kCrackOthers[] = {kCrackAngle, kCrackLaw};
// clang-format on

class CrackKind final : public FaultKind {
  public:
    std::string_view name() const override { return "crack"; }
    std::string_view words() const override { return "a crack"; }
    std::string_view title() const override { return "tooth crack"; }
    const FaultSize& size() const override { return kCrackSize; }
    std::span<const FaultKey> other_keys() const override { return kCrackOthers; }

    void check(StudyDraft& draft) const override {
        check_size(draft, {max_crack_depth_m(draft.study) * kMmPerM,
                           "longer " + deeper_than_tooth_text(draft.study)});
    }

    std::string origin(const Study& study, std::span<const double> sizes) const override {
        return crack_origin(study, sizes);
    }

    std::string share_text(const Study& study, double size) const override {
        return crack_share_text(study, size);
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        return std::make_unique<const stiffness::ToothCrack>(
            tooth.geometry.value(), material_of(study, tooth.mesh), profile_of(study), tooth.gear,
            crack_angle_rad(study), crack_law(study));
    }
};

}  // namespace

const FaultKind& crack() {
    static const CrackKind kind{};
    return kind;
}

}  // namespace gearpod::mc
