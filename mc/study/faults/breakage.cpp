// Tooth broken off over part of its face width: stiffness/faults/breakage.hpp.
#include "stiffness/faults/breakage.hpp"

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"

namespace gearpod::mc {
namespace {

using stiffness::FaceEnd;

struct Breakage : FaultShape {
    std::optional<double> width_m;   // along the face width
    std::optional<double> height_m;  // along the tooth's centre line, from the tip circle

    bool operator==(const Breakage&) const = default;
};

// clang-format off
constexpr FaultSize kBreakageSize{"break_width_mm", number<&Breakage::width_m>, kMm, kNotNegative, "width of the part that has broken off, along the face width; of helical teeth from the end that engages first"};
constexpr FaultKey kBreakageOthers[] = {
    {"break_height_mm", number<&Breakage::height_m>, kMm, kPositive, Need::optional, kFaultShape, "height of the part that has broken off, along the tooth's centre line, from the tip circle; by default the involute flank"},
};
// clang-format on

class BreakageKind final : public FaultKind {
  public:
    std::string_view name() const override { return "breakage"; }
    std::string_view words() const override { return "a partly broken tooth"; }
    std::string_view title() const override { return "partly broken tooth"; }
    const FaultSize& size() const override { return kBreakageSize; }
    std::span<const FaultKey> other_keys() const override { return kBreakageOthers; }
    bool on_one_flank() const override { return false; }

    void check(StudyDraft& draft) const override { check_on_face(draft); }

    std::string origin(const Study&, std::span<const double>) const override {
        return "width measured from one end of the face, height from the tip circle along the "
               "tooth's centre line";
    }

    SizeShare share(const Study& study) const override { return share_of_face(study); }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        const Breakage& breakage = study.fault.shapes.get<Breakage>();
        return std::make_unique<const stiffness::ToothBreakage>(
            tooth.geometry.value(), material_of(study, tooth.mesh), profile_of(study), tooth.gear,
            breakage.height_m, tooth.reversed ? FaceEnd::last : FaceEnd::first);
    }
};

}  // namespace

const FaultKind& breakage() {
    static const BreakageKind kind{};
    return kind;
}

}  // namespace gearpod::mc
