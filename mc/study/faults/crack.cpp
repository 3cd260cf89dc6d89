#include "mc/study/faults/crack.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "mc/study/gears.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::mc {
namespace {

stiffness::ToothProfile faulty_tooth(const Study& study) {
    return {gear_of(study, study.fault.member.value()), profile_of(study)};
}

std::string_view start_name(const Study& study) {
    using stiffness::Profile;
    if (gear_of(study, study.fault.member.value()).internal) {
        return "the flank's end on the root circle";
    }
    switch (profile_of(study)) {
        case Profile::base_circle:
            return "the flank's end on the base circle";
        case Profile::root_circle:
            return "the flank's end on the root circle";
        case Profile::fillet:
            break;
    }
    return crack_law(study) == stiffness::CrackLaw::sections
               ? "the fillet's end on the root circle"
               : "the fillet's surface at its 30 deg tangent (the critical section)";
}

double section_share(const Study& study, double depth_m) {
    return depth_m * std::sin(crack_angle_rad(study)) / critical_section_m(study);
}

// Crack from the tooth root straight through the face width: stiffness/faults/tooth_crack.hpp.

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

    SizeShare share(const Study& study) const override {
        return {std::sin(crack_angle_rad(study)), critical_section_m(study), "the tooth section"};
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        return std::make_unique<const stiffness::ToothCrack>(
            tooth.geometry.value(), material_of(study, tooth.mesh), profile_of(study), tooth.gear,
            crack_angle_rad(study), crack_law(study));
    }
};

// Crack with depth, height and angle that vary along the face width and as it grows:
// stiffness/faults/spatial_crack.hpp.

// Growth of a spatial crack, Yang (2022), Eqs. 61-66. Entry k of a list belongs to stage k + 1.
struct Growth : FaultShape {
    std::optional<double> stage;  // 0: healthy; linear between entries
    std::vector<double> depth_m, end_depth_m, length_m, height_m, end_height_m;
    std::optional<double> end_angle_rad;  // by default the angle at the starting face

    bool operator==(const Growth&) const = default;
};

// clang-format off
constexpr FaultSize kSpatialCrackSize{"stage", number<&Growth::stage>, kNone, kNotNegative, "growth stage of a spatial crack: 0 is healthy, k has entry k of the growth lists; linear in between"};
constexpr FaultKey kSpatialCrackOthers[] = {
    kCrackAngle,
    kCrackLaw,
    {"growth_depth_mm", numbers<&Growth::depth_m>, kMm, kPositive, Need::required, kFaultShape, "depths q1 at the face where the crack starts"},
    {"growth_end_depth_mm", numbers<&Growth::end_depth_m>, kMm, kNotNegative, Need::required, kFaultShape, "depths q2 at the other end face; 0 until the crack reaches it"},
    {"growth_length_mm", numbers<&Growth::length_m>, kMm, kPositive, Need::required, kFaultShape, "lengths L_c along the face width"},
    {"growth_height_mm", numbers<&Growth::height_m>, kMm, kNotNegative, Need::required, kFaultShape, "heights l1 above the section at which cracks start, at the face where the crack starts"},
    {"growth_end_height_mm", numbers<&Growth::end_height_m>, kMm, kNotNegative, Need::required, kFaultShape, "heights l2 at the other end face"},
    {"end_angle_deg", number<&Growth::end_angle_rad>, kDeg, Range{0.0, 90.0, true, false}, Need::optional, kFaultShape, "angle at the other end face; angle_deg by default"},
};
// clang-format on

// Rejects entries of a growth list above the limit.
void check_entries(StudyDraft& draft, const std::string& key, const std::vector<double>& list_m,
                   double limit_m, const std::string& why) {
    for (std::size_t k = 0; k < list_m.size() && draft.all_usable({key}); ++k) {
        if (list_m[k] > limit_m * kMargin) {
            draft.reject(key,
                         fmt::format("stage {}: {:.6g} mm is {}", k + 1, list_m[k] * kMmPerM, why),
                         fmt::format("stay at or below {} mm", rounded_down(limit_m * kMmPerM)));
        }
    }
}

void check_grows(StudyDraft& draft, const std::string& key, const std::vector<double>& list_m) {
    for (std::size_t k = 1; k < list_m.size() && draft.all_usable({key}); ++k) {
        if (list_m[k] < list_m[k - 1]) {
            draft.reject(key,
                         fmt::format("stage {}: {:.6g} mm is below the value of the stage before "
                                     "(a crack does not shrink)",
                                     k + 1, list_m[k] * kMmPerM),
                         "make the list non-decreasing");
        }
    }
}

// Rejects end depths of cracks that have not reached the other end face.
void check_end_depths(StudyDraft& draft, const Growth& g, double face_m) {
    const std::string key = "fault.growth_end_depth_mm";
    for (std::size_t k = 0; k < g.end_depth_m.size() && draft.all_usable({key}); ++k) {
        if (g.end_depth_m[k] > 0.0 && g.length_m[k] * kMargin < face_m) {
            draft.reject(key,
                         fmt::format("stage {} has an end depth, but its length of {:.6g} mm does "
                                     "not reach the other end face at {:.6g} mm",
                                     k + 1, g.length_m[k] * kMmPerM, face_m * kMmPerM),
                         "set it to 0, or set the length to the face width");
        }
    }
}

void check_growth(StudyDraft& draft, const Growth& g) {
    const double face_m = *draft.study.gearbox.face_width_m;
    const double deepest_m = max_crack_depth_m(draft.study);
    const double height_m = tooth_height_m(draft.study);
    const std::string deep = "deeper " + deeper_than_tooth_text(draft.study);
    const std::string high =
        fmt::format("above the tip (the tooth is {:.6g} mm high)", height_m * kMmPerM);
    const std::string wide = fmt::format("longer than the face width, {:.6g} mm", face_m * kMmPerM);
    check_entries(draft, "fault.growth_depth_mm", g.depth_m, deepest_m, deep);
    check_entries(draft, "fault.growth_end_depth_mm", g.end_depth_m, deepest_m, deep);
    check_entries(draft, "fault.growth_length_mm", g.length_m, face_m, wide);
    check_entries(draft, "fault.growth_height_mm", g.height_m, height_m, high);
    check_entries(draft, "fault.growth_end_height_mm", g.end_height_m, height_m, high);
    check_grows(draft, "fault.growth_depth_mm", g.depth_m);
    check_grows(draft, "fault.growth_end_depth_mm", g.end_depth_m);
    check_grows(draft, "fault.growth_length_mm", g.length_m);
    check_end_depths(draft, g, face_m);
}

// True if all lists are usable and have one entry for each stage.
bool check_stages(StudyDraft& draft, const Growth& g) {
    const std::size_t stages = g.depth_m.size();
    const std::pair<const char*, std::size_t> lists[] = {
        {"fault.growth_end_depth_mm", g.end_depth_m.size()},
        {"fault.growth_length_mm", g.length_m.size()},
        {"fault.growth_height_mm", g.height_m.size()},
        {"fault.growth_end_height_mm", g.end_height_m.size()}};
    bool same = draft.all_usable({"fault.growth_depth_mm"}) && stages > 0;
    for (const auto& [key, size] : lists) {
        if (!draft.all_usable({key, "fault.growth_depth_mm"})) {
            same = false;
        } else if (size != stages) {
            same = false;
            draft.reject(
                key,
                fmt::format("has {} entries, but growth_depth_mm has {} (one for each stage)", size,
                            stages),
                "give all growth lists the same length");
        }
    }
    return same;
}

class SpatialCrackKind final : public FaultKind {
  public:
    std::string_view name() const override { return "spatial-crack"; }
    std::string_view words() const override { return "a spatial crack"; }
    const FaultSize& size() const override { return kSpatialCrackSize; }
    std::span<const FaultKey> other_keys() const override { return kSpatialCrackOthers; }

    void check(StudyDraft& draft) const override {
        const Growth& g = draft.study.fault.shapes.get<Growth>();
        if (check_stages(draft, g)) {
            check_growth(draft, g);
            check_size(draft, {static_cast<double>(g.depth_m.size()),
                               fmt::format("beyond the last of the {} stages of growth",
                                           g.depth_m.size())});
        }
    }

    std::string origin(const Study& study, std::span<const double>) const override {
        return crack_origin(study, study.fault.shapes.get<Growth>().depth_m);
    }

    std::unique_ptr<const stiffness::ToothFaultFamily> family(
        const Study& study, const FaultyTooth& tooth) const override {
        const Growth& g = study.fault.shapes.get<Growth>();
        const double angle_rad = crack_angle_rad(study);
        stiffness::CrackGrowth growth;
        growth.depth_m = g.depth_m;
        growth.end_depth_m = g.end_depth_m;
        growth.length_m = g.length_m;
        growth.height_m = g.height_m;
        growth.end_height_m = g.end_height_m;
        growth.angle_rad = angle_rad;
        growth.end_angle_rad = g.end_angle_rad.value_or(angle_rad);
        return std::make_unique<const stiffness::SpatialCrack>(
            tooth.geometry.value(), material_of(study, tooth.mesh), profile_of(study), tooth.gear,
            growth, tooth.foundation, crack_law(study));
    }
};

}  // namespace

double crack_angle_rad(const Study& study) {
    return study.fault.shapes.get<CrackShape>().angle_rad;
}

stiffness::CrackLaw crack_law(const Study& study) {
    const bool fillet = profile_of(study) == stiffness::Profile::fillet;
    return study.fault.shapes.get<CrackShape>().law.value_or(
        fillet ? stiffness::CrackLaw::fracture_mechanics : stiffness::CrackLaw::sections);
}

double max_crack_depth_m(const Study& study) {
    return stiffness::max_crack_depth(faulty_tooth(study), crack_law(study),
                                      crack_angle_rad(study));
}

double critical_section_m(const Study& study) {
    const stiffness::ToothProfile tooth = faulty_tooth(study);
    return crack_law(study) == stiffness::CrackLaw::sections
               ? 2.0 * tooth.root_half_thickness()
               : stiffness::CrackPath(tooth, crack_angle_rad(study)).thickness();
}

std::string crack_origin(const Study& study, std::span<const double> depths_m) {
    std::vector<std::string> depths, shares;
    for (const double depth_m : depths_m) {
        depths.push_back(fmt::format("{:.4g}", depth_m * kMmPerM));
        shares.push_back(fmt::format("{:.3g}", 100.0 * section_share(study, depth_m)));
    }
    return fmt::format(
        "depth along the crack from {}, where the tooth is {:.4g} mm thick; {} mm is {} % of that "
        "section",
        start_name(study), critical_section_m(study) * kMmPerM, fmt::join(depths, ", "),
        fmt::join(shares, ", "));
}

std::string deeper_than_tooth_text(const Study& study) {
    return fmt::format("than the tooth (a crack at {:.4g} deg cuts through it after {} mm)",
                       crack_angle_rad(study) * 180.0 / kPi,
                       rounded_down(max_crack_depth_m(study) * kMmPerM));
}

const FaultKind& crack() {
    static const CrackKind kind{};
    return kind;
}

const FaultKind& spatial_crack() {
    static const SpatialCrackKind kind{};
    return kind;
}

}  // namespace gearpod::mc
