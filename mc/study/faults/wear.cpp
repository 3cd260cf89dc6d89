// Worn flanks of all teeth of a gear: gears/flank_gaps.hpp.
#include <fmt/format.h>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"

namespace gearpod::mc {
namespace {

struct Wear : FaultShape {
    std::optional<double> depth_m;  // where the flank wears most

    bool operator==(const Wear&) const = default;
};

// clang-format off
constexpr FaultSize kWearSize{"wear_um", number<&Wear::depth_m>, kUm, kNotNegative, "wear of all flanks of the gear, at the point that wears most, along the line of action"};
// clang-format on

class WearKind final : public FaultKind {
  public:
    std::string_view name() const override { return "wear"; }
    std::string_view words() const override { return "wear"; }
    std::string_view title() const override { return "worn flanks"; }
    const FaultSize& size() const override { return kWearSize; }
    bool wears_flanks() const override { return true; }

    void check(StudyDraft& draft) const override {
        const gears::Gear gear = gear_of(draft.study, *draft.study.fault.member);
        const double tooth_um = gear.thickness_at(gear.pitch_radius()) / kUm.to_si;
        check_size(draft, {tooth_um, fmt::format("deeper than the tooth, {:.6g} um thick at its "
                                                 "reference circle",
                                                 tooth_um)});
        if (draft.all_usable({"effects.contact_onset"}) &&
            draft.study.effects.contact_onset == ContactOnset::abrupt) {
            draft.reject("fault.kind",
                         "worn flanks start and end their contact outside of its nominal path, but "
                         "effects.contact_onset is \"abrupt\"",
                         "set contact_onset = \"extended\" in [effects]");
        }
    }

    std::string origin(const Study&, std::span<const double>) const override {
        return "normal to the flanks of all teeth, in proportion to the specific sliding: 0 at the "
               "pitch point, the given depth at the end of contact with the most sliding";
    }

    // Wear leaves the stiffness as it is.
    std::unique_ptr<const stiffness::ToothFaultFamily> family(const Study&,
                                                              const FaultyTooth&) const override {
        return nullptr;
    }
};

}  // namespace

const FaultKind& wear() {
    static const WearKind kind{};
    return kind;
}

}  // namespace gearpod::mc
