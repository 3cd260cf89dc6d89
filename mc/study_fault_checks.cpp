#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/study_draft.hpp"
#include "mc/study_gears.hpp"

namespace gearpod::mc {
namespace {

const std::string kDepth = "fault.depth_mm";
constexpr double kMmPerM = 1e3;

void reject(StudyDraft& draft, const std::string& path, std::string what, std::string remedy) {
    draft.reject(draft.position(path), path, std::move(what), std::move(remedy));
}

// Depths are compared with a relative margin for the rounding of unit conversions.
bool too_long(double depth_mm, double limit_mm) {
    return depth_mm > limit_mm * (1.0 + 1e-12);
}

void check_depth(StudyDraft& draft) {
    const double limit_mm = max_fault_depth_m(draft.study) * kMmPerM;
    // Rounded down, so that the depth named is allowed.
    const double shown = std::floor(limit_mm * 1e4) / 1e4;
    const std::string remedy = fmt::format("stay at or below {} mm", shown);
    const auto what = [&](double depth_mm) {
        return fmt::format(
            "{} mm is longer than the tooth (a crack at {:.4g} deg leaves it after "
            "{} mm)",
            depth_mm, draft.study.fault.angle_rad * 180.0 / M_PI, shown);
    };
    const double nominal_mm = draft.study.fault.depth_m.value_or(0.0) * kMmPerM;
    if (draft.given.contains(kDepth) && too_long(nominal_mm, limit_mm)) {
        draft.reject(draft.given.at(kDepth), kDepth, what(nominal_mm), remedy);
    }
    const RandomInput* random = draft.study.find_random(kDepth);
    if (random != nullptr && too_long(random->distribution.support().high, limit_mm)) {
        draft.reject(draft.given_random.at(kDepth), "random." + kDepth,
                     what(random->distribution.support().high), remedy);
    }
}

void check_tooth(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.gearbox.tooth_profile == ToothProfile::constant &&
        draft.usable("gearbox.tooth_profile")) {
        reject(draft, "fault.kind",
               "a crack needs the shape of its tooth (gearbox.tooth_profile is \"constant\")",
               "use tooth_profile = \"root-circle\", or fault.kind = \"none\"");
        return;
    }
    const bool planet = s.fault.member == Member::planet;
    if (planet && draft.usable("gearbox.planets") && draft.usable("fault.planet") &&
        s.gearbox.planets >= 1 && s.fault.planet > s.gearbox.planets) {
        reject(draft, "fault.planet",
               fmt::format("is {}, but there are {} planets", s.fault.planet, s.gearbox.planets),
               fmt::format("name a planet from 1 to {}", s.gearbox.planets));
    }
    const std::string geometry[] = {"gearbox",
                                    "fault",
                                    "gearbox.sun_teeth",
                                    "gearbox.planet_teeth",
                                    "gearbox.ring_teeth",
                                    "gearbox.module_mm",
                                    "gearbox.pressure_angle_deg",
                                    "gearbox.addendum_coefficient",
                                    "gearbox.dedendum_coefficient",
                                    "gearbox.tooth_profile",
                                    "fault.member",
                                    "fault.angle_deg"};
    const bool known = std::all_of(std::begin(geometry), std::end(geometry),
                                   [&](const std::string& path) { return draft.usable(path); });
    if (known && s.gearbox.has_teeth() && s.gearbox.module_m && s.fault.member) {
        check_depth(draft);
    }
}

void check_edges_given(StudyDraft& draft, const Distribution& depth) {
    const std::vector<double>& edges = draft.study.detection.size_edges_m;
    if (edges.empty()) {
        reject(draft, "detection.size_edges_mm",
               fmt::format("missing (random.fault.depth_mm is {}, whose sizes are grouped)",
                           depth.name()),
               "add size_edges_mm = [...] to [detection]");
        return;
    }
    const Support support = depth.support();
    const double margin = 1.0 + 1e-12;
    if (edges.size() < 2 || edges.front() * kMmPerM > support.low * margin ||
        edges.back() * kMmPerM * margin < support.high) {
        reject(draft, "detection.size_edges_mm",
               fmt::format("does not cover all depths, {} to {} mm", support.low, support.high),
               "let the first edge be the smallest and the last the largest depth, or beyond");
    }
}

// Edges group continuous sizes; levels are their own groups.
void check_edges(StudyDraft& draft) {
    if (!draft.usable(kDepth) || !draft.usable("detection.size_edges_mm") ||
        !draft.usable("detection")) {
        return;
    }
    const RandomInput* random = draft.study.find_random(kDepth);
    const bool continuous = draft.study.fault.kind == FaultKind::crack && random != nullptr &&
                            random->distribution.levels().empty();
    if (continuous) {
        check_edges_given(draft, random->distribution);
    } else if (draft.is_given("detection.size_edges_mm") &&
               draft.study.fault.kind == FaultKind::crack) {
        reject(draft, "detection.size_edges_mm",
               "has no place here (fault.depth_mm is not continuous: each depth is its own group)",
               "remove it");
    }
}

}  // namespace

void check_fault(StudyDraft& draft) {
    if (!draft.usable("fault.kind")) {
        return;
    }
    if (draft.study.fault.kind == FaultKind::crack) {
        check_tooth(draft);
    }
    check_edges(draft);
}

}  // namespace gearpod::mc
