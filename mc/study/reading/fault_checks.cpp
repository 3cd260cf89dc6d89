// Checks of the fault: that its member, side and profile can have it, and that it fits the tooth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

constexpr double kMmPerM = 1e3;
constexpr double kMargin = 1.0 + 1e-12;  // for the rounding of unit conversions

std::string_view kind_name(FaultKind kind) {
    constexpr std::string_view kNames[] = {"no fault",   "a crack", "a spatial crack",
                                           "a chip",     "pitting", "a broken tooth",
                                           "a reduction"};
    return kNames[static_cast<int>(kind)];
}

// Whether it changes the tooth's sections or its contact, and not just the pair's stiffness.
bool shapes_tooth(FaultKind kind) {
    return kind != FaultKind::none && kind != FaultKind::broken && kind != FaultKind::reduction;
}

void check_member(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!s.fault.member || !draft.all_usable({"gearbox.kind", "fault.member"}) ||
        has_toothed_member(s.gearbox.kind, *s.fault.member)) {
        return;
    }
    const bool planetary = s.gearbox.kind == GearboxKind::planetary;
    draft.reject("fault.member",
                 fmt::format("is \"{}\", which a {} gearbox does not have",
                             member_name(*s.fault.member), planetary ? "planetary" : "fixed-shaft"),
                 planetary ? "use \"planet\", \"sun\" or \"ring\"" : "use \"pinion\" or \"gear\"");
}

void check_planet(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.fault.member != Member::planet || !draft.all_usable({"fault.member"})) {
        return;
    }
    if (draft.all_usable({"gearbox.planets", "fault.planet"}) && s.gearbox.planets >= 1 &&
        s.fault.planet > s.gearbox.planets) {
        draft.reject(
            "fault.planet",
            fmt::format("is {}, but there are {} planets", s.fault.planet, s.gearbox.planets),
            fmt::format("name a planet from 1 to {}", s.gearbox.planets));
    }
    if (draft.all_usable({"fault.side"}) && s.fault.side == FaultSide::both &&
        shapes_tooth(s.fault.kind)) {
        draft.reject("fault.side",
                     fmt::format("is \"both\" ({} lies on one flank, and each flank meets one of "
                                 "sun and ring)",
                                 kind_name(s.fault.kind)),
                     "use \"ring\" or \"sun\"");
    }
}

// Whether the tooth has a shape that a fault can change.
bool check_profile(StudyDraft& draft) {
    const ToothProfile profile = draft.study.gearbox.tooth_profile;
    if (!stiffness_given(draft.study) || !shapes_tooth(draft.study.fault.kind) ||
        !draft.usable("gearbox.tooth_profile")) {
        return true;
    }
    draft.reject("fault.kind",
                 fmt::format("{} needs the shape of its tooth (gearbox.tooth_profile is \"{}\")",
                             kind_name(draft.study.fault.kind),
                             profile == ToothProfile::constant ? "constant" : "square-wave"),
                 "use fault.kind = \"reduction\" or \"broken\", or tooth_profile = "
                 "\"root-circle\", \"base-circle\" or \"fillet\"");
    return false;
}

// The largest size that the tooth holds, and why, in the file's unit.
struct SizeLimit {
    double largest;
    std::string why;  // "longer than the tooth (...)"
};

// Rounded down, so that the size named is allowed.
double shown(double limit) {
    return std::floor(limit * 1e4) / 1e4;
}

void check_size(StudyDraft& draft, const SizeLimit& limit) {
    const Key& key = fault_size_key(draft.study);
    const std::string path = key.path();
    const std::string unit = key.unit.suffix.empty() ? "" : " " + std::string(key.unit.name);
    const std::string remedy = fmt::format("stay at or below {}{}", shown(limit.largest), unit);
    const auto what = [&](double size) { return fmt::format("{}{} is {}", size, unit, limit.why); };
    const double nominal = fault_size(draft.study) / key.unit.to_si;
    if (draft.given.contains(path) && nominal > limit.largest * kMargin) {
        draft.reject(draft.given.at(path), path, what(nominal), remedy);
    }
    const RandomInput* random = draft.study.find_random(path);
    if (random != nullptr && random->distribution.support().high > limit.largest * kMargin) {
        draft.reject(draft.given_random.at(path), "random." + path,
                     what(random->distribution.support().high), remedy);
    }
}

void check_crack(StudyDraft& draft) {
    const double limit_mm = max_crack_depth_m(draft.study) * kMmPerM;
    check_size(draft, {limit_mm,
                       fmt::format("longer than the tooth (a crack at {:.4g} deg leaves "
                                   "it after {} mm)",
                                   draft.study.fault.angle_rad * 180.0 / M_PI, shown(limit_mm))});
}

// Every entry of a growth list stays at or below the limit.
void check_entries(StudyDraft& draft, const std::string& key, const std::vector<double>& list_m,
                   double limit_m, const std::string& why) {
    for (std::size_t k = 0; k < list_m.size() && draft.all_usable({key}); ++k) {
        if (list_m[k] > limit_m * kMargin) {
            draft.reject(key,
                         fmt::format("stage {}: {:.6g} mm is {}", k + 1, list_m[k] * kMmPerM, why),
                         fmt::format("stay at or below {} mm", shown(limit_m * kMmPerM)));
        }
    }
}

void check_grows(StudyDraft& draft, const std::string& key, const std::vector<double>& list_m) {
    for (std::size_t k = 1; k < list_m.size() && draft.all_usable({key}); ++k) {
        if (list_m[k] < list_m[k - 1]) {
            draft.reject(key,
                         fmt::format("stage {}: {:.6g} mm is below the stage before it (a crack "
                                     "does not shrink)",
                                     k + 1, list_m[k] * kMmPerM),
                         "let the list grow or stay");
        }
    }
}

// An end depth belongs to a crack that has reached the other end face.
void check_end_depths(StudyDraft& draft, double face_m) {
    const Fault& f = draft.study.fault;
    const std::string key = "fault.growth_end_depth_mm";
    for (std::size_t k = 0; k < f.growth_end_depth_m.size() && draft.all_usable({key}); ++k) {
        if (f.growth_end_depth_m[k] > 0.0 && f.growth_length_m[k] * kMargin < face_m) {
            draft.reject(key,
                         fmt::format("stage {} has an end depth, but its length of {:.6g} mm does "
                                     "not reach the other end face at {:.6g} mm",
                                     k + 1, f.growth_length_m[k] * kMmPerM, face_m * kMmPerM),
                         "make it 0, or the length the face width");
        }
    }
}

void check_growth(StudyDraft& draft, double face_m) {
    const Fault& f = draft.study.fault;
    const gears::Gear gear = gear_of(draft.study, *f.member);
    const double deepest_m = max_crack_depth_m(draft.study);
    const double height_m = std::abs(gear.tip_radius() - gear.root_radius());
    const std::string deep =
        fmt::format("deeper than the tooth (a crack at {:.4g} deg leaves it after {} mm)",
                    f.angle_rad * 180.0 / M_PI, shown(deepest_m * kMmPerM));
    const std::string high =
        fmt::format("above the tip (the tooth is {:.6g} mm high)", height_m * kMmPerM);
    const std::string wide = fmt::format("longer than the face width, {:.6g} mm", face_m * kMmPerM);
    check_entries(draft, "fault.growth_depth_mm", f.growth_depth_m, deepest_m, deep);
    check_entries(draft, "fault.growth_end_depth_mm", f.growth_end_depth_m, deepest_m, deep);
    check_entries(draft, "fault.growth_length_mm", f.growth_length_m, face_m, wide);
    check_entries(draft, "fault.growth_height_mm", f.growth_height_m, height_m, high);
    check_entries(draft, "fault.growth_end_height_mm", f.growth_end_height_m, height_m, high);
    check_grows(draft, "fault.growth_depth_mm", f.growth_depth_m);
    check_grows(draft, "fault.growth_end_depth_mm", f.growth_end_depth_m);
    check_grows(draft, "fault.growth_length_mm", f.growth_length_m);
    check_end_depths(draft, face_m);
}

void check_spatial_crack(StudyDraft& draft, double face_m) {
    const Fault& f = draft.study.fault;
    const std::size_t stages = f.growth_depth_m.size();
    const std::pair<const char*, std::size_t> lists[] = {
        {"fault.growth_end_depth_mm", f.growth_end_depth_m.size()},
        {"fault.growth_length_mm", f.growth_length_m.size()},
        {"fault.growth_height_mm", f.growth_height_m.size()},
        {"fault.growth_end_height_mm", f.growth_end_height_m.size()}};
    bool same = draft.all_usable({"fault.growth_depth_mm"}) && stages > 0;
    for (const auto& [key, size] : lists) {
        if (!draft.all_usable({key, "fault.growth_depth_mm"})) {
            same = false;
        } else if (size != stages) {
            same = false;
            draft.reject(key,
                         fmt::format("has {} entries, but growth_depth_mm has {} (one a stage)",
                                     size, stages),
                         "give all growth lists the same length");
        }
    }
    if (same) {
        check_growth(draft, face_m);
        check_size(draft, {static_cast<double>(stages),
                           fmt::format("beyond the last of the {} stages of growth", stages)});
    }
}

void check_chip(StudyDraft& draft, double face_m) {
    const std::string height_key = "fault.chip_height_mm";
    check_size(draft,
               {face_m * kMmPerM, fmt::format("wider than the face, {:.6g} mm", face_m * kMmPerM)});
    const gears::Gear gear = gear_of(draft.study, *draft.study.fault.member);
    const double height_mm = std::abs(gear.tip_radius() - gear.root_radius()) * kMmPerM;
    const double chip_mm = draft.study.fault.chip_height_m.value_or(0.0) * kMmPerM;
    if (draft.all_usable({height_key}) && chip_mm >= height_mm) {
        draft.reject(
            height_key,
            fmt::format("{:.6g} mm takes the whole tooth off ({:.6g} mm high)", chip_mm, height_mm),
            "give a smaller height, or use fault.kind = \"broken\"");
    }
}

void check_pitting(StudyDraft& draft, double face_m) {
    const Study& s = draft.study;
    check_size(draft,
               {face_m * kMmPerM, fmt::format("wider than the face, {:.6g} mm", face_m * kMmPerM)});
    if (draft.all_usable({"fault.teeth"}) && s.fault.teeth > *teeth_of(s, *s.fault.member)) {
        draft.reject("fault.teeth",
                     fmt::format("is {}, but the {} has {} teeth", s.fault.teeth,
                                 member_name(*s.fault.member), *teeth_of(s, *s.fault.member)),
                     "");
    }
    if (!s.fault.pit_radius_m || !s.fault.pit_length_m ||
        !draft.all_usable({"fault.pit_radius_mm", "fault.pit_length_mm", "fault.side"})) {
        return;
    }
    const ActiveFlank flank = active_flank(s);
    const double half = 0.5 * *s.fault.pit_length_m;
    if (*s.fault.pit_radius_m - half < flank.low_m / kMargin ||
        *s.fault.pit_radius_m + half > flank.high_m * kMargin) {
        draft.reject("fault.pit_radius_mm",
                     fmt::format("the pitted band from {:.6g} to {:.6g} mm leaves the flank that "
                                 "is touched, {:.6g} to {:.6g} mm",
                                 (*s.fault.pit_radius_m - half) * kMmPerM,
                                 (*s.fault.pit_radius_m + half) * kMmPerM, flank.low_m * kMmPerM,
                                 flank.high_m * kMmPerM),
                     "move the band or shorten it");
    }
}

// What needs the faulty tooth itself.
void check_shape(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!draft.all_usable({"gearbox.kind", "gearbox.module_mm", "gearbox.pressure_angle_deg",
                           "gearbox.addendum_coefficient", "gearbox.dedendum_coefficient",
                           "gearbox.face_width_mm", "gearbox.tooth_profile", "fault.member",
                           "fault.angle_deg"}) ||
        !s.fault.member || !has_gears(s) || !s.gearbox.face_width_m) {
        return;
    }
    for (const MeshMembers& mesh : meshes_of(s.gearbox.kind)) {
        for (const Member member : {mesh.driver, mesh.driven}) {
            if (!draft.usable(fmt::format("gearbox.{}_teeth", member_name(member)))) {
                return;
            }
        }
    }
    switch (s.fault.kind) {
        case FaultKind::crack:
            return check_crack(draft);
        case FaultKind::spatial_crack:
            return check_spatial_crack(draft, *s.gearbox.face_width_m);
        case FaultKind::chip:
            return check_chip(draft, *s.gearbox.face_width_m);
        case FaultKind::pitting:
            return check_pitting(draft, *s.gearbox.face_width_m);
        default:
            return;
    }
}

void check_edges_given(StudyDraft& draft, const Distribution& size) {
    const Key& key = fault_size_key(draft.study);
    const std::string edges_key = size_edges_key(draft.study);
    const std::string edges_name = edges_key.substr(edges_key.find('.') + 1);
    const std::vector<double>& edges = size_edges(draft.study);
    if (edges.empty()) {
        draft.reject(edges_key,
                     fmt::format("missing (random.{} is {}, whose sizes are grouped)", key.path(),
                                 size.name()),
                     fmt::format("add {} = [...] to [detection]", edges_name));
        return;
    }
    const Support support = size.support();
    if (edges.size() < 2 || edges.front() / key.unit.to_si > support.low * kMargin ||
        edges.back() / key.unit.to_si * kMargin < support.high) {
        const std::string unit = key.unit.suffix.empty() ? "" : " " + std::string(key.unit.name);
        draft.reject(
            edges_key,
            fmt::format("does not cover all sizes, {} to {}{}", support.low, support.high, unit),
            "let the first edge be the smallest and the last the largest size, or beyond");
    }
}

// Edges group continuous sizes; levels are their own groups.
void check_edges(StudyDraft& draft) {
    if (draft.study.fault.kind == FaultKind::none) {
        return;
    }
    const std::string size_key = fault_size_key(draft.study).path();
    const std::string edges_key = size_edges_key(draft.study);
    if (!draft.usable(size_key) || !draft.all_usable({edges_key})) {
        return;
    }
    const RandomInput* random = draft.study.find_random(size_key);
    if (random != nullptr && random->distribution.levels().empty()) {
        check_edges_given(draft, random->distribution);
    } else if (draft.is_given(edges_key)) {
        draft.reject(edges_key,
                     fmt::format("has no place here ({} is not continuous: each size is its own "
                                 "group)",
                                 size_key),
                     "remove it");
    }
}

}  // namespace

void check_fault(StudyDraft& draft) {
    if (!draft.all_usable({"fault", "fault.kind"})) {
        return;
    }
    if (draft.study.fault.kind != FaultKind::none) {
        check_member(draft);
        check_planet(draft);
        if (check_profile(draft)) {
            check_shape(draft);
        }
    }
    check_edges(draft);
}

}  // namespace gearpod::mc
