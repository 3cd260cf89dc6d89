// Pits on the flanks of one or several neighbouring teeth: stiffness/faults/pitting.hpp.
#include "stiffness/faults/pitting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gears/mesh_geometry.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/keys/schema_line.hpp"

namespace gearpod::mc {
namespace {

struct Pits : FaultShape {
    std::optional<double> width_m;  // along the face width
    // Length of the band along the profile, radius of its centre, depth of the pits.
    std::optional<double> length_m, radius_m, depth_m;
    int teeth = 1;  // neighbouring pitted teeth

    bool operator==(const Pits&) const = default;
};

// clang-format off
constexpr FaultSize kPittingSize{"pit_width_mm", number<&Pits::width_m>, kMm, kNotNegative, "width of the pitted band along the face width"};
constexpr FaultKey kPittingOthers[] = {
    {"pit_length_mm", number<&Pits::length_m>, kMm, kPositive, Need::required, kFaultShape, "length of the pitted band along the involute profile"},
    {"pit_radius_mm", number<&Pits::radius_m>, kMm, kPositive, Need::required, kFaultShape, "distance of the band's centre from the gear's axis"},
    {"pit_depth_mm", number<&Pits::depth_m>, kMm, kNotNegative, Need::required, kFaultShape, "depth of the pits under the flank"},
    {"teeth", integer<&Pits::teeth>, kNone, closed_range(1, 100), Need::optional, kFaultShape, "number of neighbouring pitted teeth"},
};
// clang-format on

// Mating member of the faulty flank.
Member mate_of(const Fault& fault) {
    switch (*fault.member) {
        case Member::planet:
            return fault.side == FaultSide::sun ? Member::sun : Member::ring;
        case Member::pinion:
            return Member::gear;
        case Member::gear:
            return Member::pinion;
        case Member::sun:
        case Member::ring:
        case Member::carrier:
            return Member::planet;
    }
    return Member::planet;
}

// Lowest and highest radius of the faulty member's flank that its mate touches, m; for a planet, of
// the flank on the faulty side.
struct ActiveFlank {
    double low_m, high_m;
};
ActiveFlank active_flank(const Study& study) {
    const Member member = *study.fault.member, mate = mate_of(study.fault);
    const bool is_first = member == Member::sun || member == Member::pinion || mate == Member::ring;
    const gears::MeshGeometry mesh(gear_of(study, is_first ? member : mate),
                                   gear_of(study, is_first ? mate : member),
                                   working_shifts(study).centre_distance_m);
    const int which = is_first ? 1 : 2;
    const double ends[] = {mesh.contact_radius(which, 0.0),
                           mesh.contact_radius(which, mesh.contact_ratio())};
    return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

void check_teeth(StudyDraft& draft, const Pits& pits) {
    const Member member = *draft.study.fault.member;
    const int teeth = *teeth_of(draft.study, member);
    if (draft.all_usable({"fault.teeth"}) && pits.teeth > teeth) {
        draft.reject(
            "fault.teeth",
            fmt::format("is {}, but the {} has {} teeth", pits.teeth, member_name(member), teeth),
            "");
    }
}

void check_band(StudyDraft& draft, const Pits& pits) {
    if (!pits.radius_m || !pits.length_m ||
        !draft.all_usable({"fault.pit_radius_mm", "fault.pit_length_mm", "fault.side"})) {
        return;
    }
    const ActiveFlank flank = active_flank(draft.study);
    const double low_m = *pits.radius_m - 0.5 * *pits.length_m,
                 high_m = *pits.radius_m + 0.5 * *pits.length_m;
    if (low_m < flank.low_m / kMargin || high_m > flank.high_m * kMargin) {
        draft.reject("fault.pit_radius_mm",
                     fmt::format("the pitted band from {:.6g} to {:.6g} mm extends beyond the "
                                 "active flank, {:.6g} to {:.6g} mm",
                                 low_m * kMmPerM, high_m * kMmPerM, flank.low_m * kMmPerM,
                                 flank.high_m * kMmPerM),
                     "move the band or shorten it");
    }
}

class PittingKind final : public FaultKind {
  public:
    std::string_view name() const override { return "pitting"; }
    std::string_view words() const override { return "pitting"; }
    const FaultSize& size() const override { return kPittingSize; }
    std::span<const FaultKey> other_keys() const override { return kPittingOthers; }

    void check(StudyDraft& draft) const override {
        const Pits& pits = draft.study.fault.shapes.get<Pits>();
        check_on_face(draft);
        check_teeth(draft, pits);
        check_band(draft, pits);
    }

    std::string origin(const Study&, std::span<const double>) const override {
        return "a rectangle on the working flank, its depth measured from the flank";
    }

    SizeShare share(const Study& study) const override { return share_of_face(study); }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        const Pits& pits = study.fault.shapes.get<Pits>();
        return std::make_unique<const stiffness::ToothPitting>(
            tooth.geometry.value(), material_of(study, tooth.mesh), profile_of(study), tooth.gear,
            stiffness::PitBand{*pits.radius_m, *pits.length_m, *pits.depth_m, pits.teeth});
    }
};

}  // namespace

const FaultKind& pitting() {
    static const PittingKind kind{};
    return kind;
}

}  // namespace gearpod::mc
