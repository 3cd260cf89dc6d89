// Checks of the fault against its member, side and tooth profile, and against the size of the
// tooth.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/detection/detection.hpp"
#include "features/feature.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

// Quoted names of the kinds that need no tooth shape, the simplest one first: "reduction" or
// "broken".
std::string shapeless_kinds() {
    std::string names;
    const auto kinds = all_faults();
    for (auto kind = kinds.rbegin(); kind != kinds.rend(); ++kind) {
        if (!(*kind)->shapes_tooth()) {
            names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", (*kind)->name());
        }
    }
    return names;
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
        s.fault.kind->on_one_flank()) {
        draft.reject(
            "fault.side",
            fmt::format(
                "is \"both\", but {} is on one flank, which meets either the sun or the ring",
                s.fault.kind->words()),
            "use \"ring\" or \"sun\"");
    }
}

// True if the fault needs no tooth shape or the study has one.
bool check_profile(StudyDraft& draft) {
    const StiffnessSource profile = draft.study.gearbox.tooth_profile;
    if (!stiffness_given(draft.study) || !draft.study.fault.kind->shapes_tooth() ||
        !draft.usable("gearbox.tooth_profile")) {
        return true;
    }
    draft.reject("fault.kind",
                 fmt::format("{} needs the shape of its tooth (gearbox.tooth_profile is \"{}\")",
                             draft.study.fault.kind->words(),
                             profile == StiffnessSource::constant ? "constant" : "square-wave"),
                 fmt::format("use fault.kind = {}, or tooth_profile = "
                             "\"root-circle\", \"base-circle\" or \"fillet\"",
                             shapeless_kinds()));
    return false;
}

// Checks that need the geometry of the faulty tooth.
void check_shape(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!draft.all_usable({"gearbox.kind", "gearbox.module_mm", "gearbox.pressure_angle_deg",
                           "gearbox.addendum_coefficient", "gearbox.dedendum_coefficient",
                           "gearbox.face_width_mm", "gearbox.tooth_profile", "fault.member",
                           "fault.angle_deg"}) ||
        !draft.all_usable(shift_keys()) || !s.fault.member || !has_gears(s) ||
        !s.gearbox.face_width_m) {
        return;
    }
    for (const MeshMembers& mesh : meshes_of(s.gearbox.kind)) {
        for (const Member member : {mesh.member_1, mesh.member_2}) {
            if (!draft.usable(teeth_key(member))) {
                return;
            }
        }
    }
    s.fault.kind->check(draft);
}

void check_edges_given(StudyDraft& draft, const Distribution& size) {
    const Key& key = fault_size_key(draft.study);
    const std::string edges_key = size_edges_key(draft.study);
    const std::string edges_name = edges_key.substr(edges_key.find('.') + 1);
    const std::vector<double>& edges = size_edges(draft.study);
    if (edges.empty()) {
        draft.reject(
            edges_key,
            fmt::format(
                "missing (random.{} is {}, a continuous distribution, whose sizes must be grouped)",
                key.path(), size.name()),
            fmt::format("add {} = [...] to [detection]", edges_name));
        return;
    }
    const Support support = size.in_unit_of_file().support();
    if (edges.size() < 2 || edges.front() / key.unit.to_si > support.low * kMargin ||
        edges.back() / key.unit.to_si * kMargin < support.high) {
        const std::string unit = key.unit.suffix.empty() ? "" : " " + std::string(key.unit.name);
        draft.reject(
            edges_key,
            fmt::format("does not cover all fault sizes of the study, {} to {}{}", support.low,
                        support.high, unit),
            "start with an edge at or below the smallest size and end with one at or above the "
            "largest");
    }
}

// Continuous sizes are grouped by edges; discrete levels form their own groups.
void check_edges(StudyDraft& draft) {
    if (draft.study.fault.kind == nullptr) {
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
        draft.reject(
            edges_key,
            fmt::format("is not allowed here ({} is not continuous: each size is its own group)",
                        size_key),
            "remove it");
    }
}

}  // namespace

void check_faulty_member(StudyDraft& draft) {
    const Study& s = draft.study;
    if (!s.fault.member || !draft.is_given("gearbox.kind") ||
        !draft.all_usable({"gearbox.kind", "fault.kind", "fault.member"}) ||
        has_toothed_member(s.gearbox.kind, *s.fault.member)) {
        return;
    }
    const bool planetary = s.gearbox.kind == GearboxKind::planetary;
    draft.reject("fault.member",
                 fmt::format("is \"{}\", which a {} gearbox does not have",
                             member_name(*s.fault.member), planetary ? "planetary" : "fixed-shaft"),
                 planetary ? "use \"planet\", \"sun\" or \"ring\"" : "use \"pinion\" or \"gear\"");
}

void check_fault(StudyDraft& draft) {
    if (!draft.all_usable({"fault", "fault.kind"})) {
        return;
    }
    if (draft.study.fault.kind != nullptr) {
        check_planet(draft);
        if (check_profile(draft)) {
            check_shape(draft);
        }
    }
    check_edges(draft);
}

}  // namespace gearpod::mc
