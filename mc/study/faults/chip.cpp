// Chip off one end of a tooth's tip: stiffness/faults/chip.hpp.
#include "stiffness/faults/chip.hpp"

#include <fmt/format.h>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"

namespace gearpod::mc {
namespace {

using stiffness::FaceEnd;

struct Chip : FaultShape {
    std::optional<double> width_m;   // along the face width, at the tip
    std::optional<double> height_m;  // along the tooth

    bool operator==(const Chip&) const = default;
};

// clang-format off
constexpr FaultSize kChipSize{"chip_mm", number<&Chip::width_m>, kMm, kNotNegative, "width of the chip along the face width, at the tip; of helical teeth from the end that engages first"};
constexpr FaultKey kChipOthers[] = {
    {"chip_height_mm", number<&Chip::height_m>, kMm, kPositive, Need::optional, kFaultShape, "height of the chip along the tooth, from the tip; a quarter of its width by default"},
};
// clang-format on

class ChipKind final : public FaultKind {
  public:
    std::string_view name() const override { return "chip"; }
    std::string_view words() const override { return "a chip"; }
    const FaultSize& size() const override { return kChipSize; }
    std::span<const FaultKey> other_keys() const override { return kChipOthers; }

    void check(StudyDraft& draft) const override {
        const std::string height_key = "fault.chip_height_mm";
        check_on_face(draft);
        const double tooth_mm = tooth_height_m(draft.study) * kMmPerM;
        const double chip_mm =
            draft.study.fault.shapes.get<Chip>().height_m.value_or(0.0) * kMmPerM;
        if (draft.all_usable({height_key}) && chip_mm >= tooth_mm) {
            draft.reject(height_key,
                         fmt::format("{:.6g} mm removes the whole tooth, which is {:.6g} mm high",
                                     chip_mm, tooth_mm),
                         "give a smaller height, or use fault.kind = \"broken\"");
        }
    }

    std::string origin(const Study&, std::span<const double>) const override {
        return "width measured from one end of the tip, height from the tip circle down the flank";
    }

    SizeShare share(const Study& study) const override { return share_of_face(study); }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        const Chip& chip = study.fault.shapes.get<Chip>();
        return std::make_unique<const stiffness::ToothChip>(
            tooth.geometry.value(), *study.gearbox.face_width_m, tooth.gear, chip.height_m,
            tooth.reversed ? FaceEnd::last : FaceEnd::first);
    }
};

}  // namespace

const FaultKind& chip() {
    static const ChipKind kind{};
    return kind;
}

}  // namespace gearpod::mc
