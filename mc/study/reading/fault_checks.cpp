// Checks of the fault against its member, side and tooth profile, and against the size of the
// tooth.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "machine/contracts.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/faults/fault_kind.hpp"
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
        draft.reject(edges_key,
                     fmt::format("missing (random.{} is {}, whose sizes must be grouped)",
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

// Checks of lives: the crack, its depths, and that records remain after the baseline.

void check_curve(StudyDraft& draft) {
    const Life& life = draft.study.life;
    if (life.curve_h.empty()) {
        return;
    }
    if (life.curve_h.size() != life.curve_depth_m.size() || life.curve_h.size() < 2) {
        draft.reject("life.curve_depth_mm",
                     fmt::format("has {} depths, but curve_h has {} hours",
                                 life.curve_depth_m.size(), life.curve_h.size()),
                     "give at least two depths, one for each hour of curve_h");
    } else if (life.curve_h.front() != 0.0) {
        draft.reject("life.curve_h", fmt::format("begins at {:g} h", life.curve_h.front()),
                     "begin at 0, when the crack starts");
    } else if (life.curve_depth_m.back() < *life.last_depth_m) {
        draft.reject("life.curve_depth_mm",
                     fmt::format("ends at {:g} mm, which is below last_depth_mm, {:g} mm",
                                 1e3 * life.curve_depth_m.back(), 1e3 * *life.last_depth_m),
                     "continue the curve to last_depth_mm");
    }
}

void check_loads(StudyDraft& draft) {
    const Study& study = draft.study;
    const Life& life = study.life;
    const auto check = [&](const char* key, const std::optional<int>& nodes,
                           const std::optional<int>& distinct, RecordQuantity quantity,
                           double scatter) {
        const bool by_law = std::ranges::any_of(study.random, [&](const RandomInput& input) {
            return input.distribution.per_record() && input.quantity == quantity;
        });
        if (distinct && nodes) {
            draft.reject(fmt::format("life.distinct_{}s", key),
                         fmt::format("conflicts with life.integrated_{}s: nothing is interpolated "
                                     "between distinct values",
                                     key),
                         "remove one of them");
        }
        if (nodes && scatter == 0.0 && !by_law) {
            draft.reject(
                fmt::format("life.integrated_{}s", key),
                fmt::format("all records have the same {}, so nothing is interpolated", key),
                fmt::format("remove it, or let the records' {0} vary (life.{0}_scatter)", key));
        }
    };
    check("torque", life.polynomial_torques, life.distinct_torques, RecordQuantity::torque,
          life.torque_scatter);
    check("speed", life.polynomial_speeds, life.distinct_speeds, RecordQuantity::speed,
          life.speed_scatter);
}

// A baseline of too few records has no scatter estimate, and baseline_deviations() are then NaN.
void check_watch(StudyDraft& draft) {
    const Life& life = draft.study.life;
    const Monitoring& watch = draft.study.monitoring;
    const int least = watch.torque_regression ? 4 : 3;
    if (watch.baseline_records > 0 && watch.baseline_records < least) {
        draft.reject(
            "monitoring.baseline_records",
            fmt::format("{} records are too few to estimate their scatter{}",
                        watch.baseline_records,
                        watch.torque_regression ? " about a line in the torque" : ""),
            fmt::format("use at least {}, or 0 to monitor the features without a baseline", least));
    }
    if (watch.average_records > 1) {
        draft.reject(
            "monitoring.average_records",
            "averages measured recordings, but a life's records are not averaged after "
            "one another",
            "remove it; life.recordings is the number of recordings that a record averages");
    }
    const double most = 1000.0 / *life.interval_h;
    if (watch.false_alarms_per_1000_h >= most) {
        draft.reject(
            "monitoring.false_alarms_per_1000_h",
            fmt::format(
                "{:g} is one alarm or more in every record of a healthy gearbox (life.interval_h)",
                watch.false_alarms_per_1000_h),
            fmt::format("give a value below {:.6g}", most));
    }
}

// Checks that do not concern the crack.
void check_records_of_lives(StudyDraft& draft) {
    const Study& study = draft.study;
    const Life& life = study.life;
    check_loads(draft);
    if (draft.all_usable({"monitoring.baseline_records", "monitoring.false_alarms_per_1000_h"})) {
        check_watch(draft);
    }
    if (study.ensemble.threshold_records > 1) {
        draft.reject("ensemble.threshold_records", "is not allowed with life.interval_h",
                     "remove it; life.records is the number of records of a life");
    }
    if (draft.all_usable({"life.records", "monitoring.baseline_records"}) &&
        life.records <= study.monitoring.baseline_records) {
        draft.reject("life.records",
                     fmt::format("{} is not above monitoring.baseline_records, {}", life.records,
                                 study.monitoring.baseline_records),
                     "raise records");
    }
}

void check_depths(StudyDraft& draft) {
    const Life& life = draft.study.life;
    EXPECTS(life.last_depth_m);
    check_curve(draft);
    const bool begins =
        life.curve_h.empty() ? life.first_depth_m.has_value() : !life.curve_depth_m.empty();
    if (begins &&
        draft.all_usable({"life.first_depth_mm", "life.curve_h", "life.curve_depth_mm"}) &&
        crack_begin_m(life) >= *life.last_depth_m) {
        draft.reject(life.curve_h.empty() ? "life.first_depth_mm" : "life.curve_depth_mm",
                     fmt::format("{:g} mm is not below last_depth_mm, {:g} mm",
                                 1e3 * crack_begin_m(life), 1e3 * *life.last_depth_m),
                     "begin with a shallower crack");
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

void check_life(StudyDraft& draft) {
    const Study& study = draft.study;
    const Life& life = study.life;
    if (!life.interval_h || !draft.usable("life.interval_h")) {
        return;
    }
    // The geometry can be used only if there is no other problem.
    const bool sound = draft.problems.empty();
    check_records_of_lives(draft);
    if (study.fault.kind == nullptr || study.fault.kind->name() != "crack") {
        draft.reject("life.interval_h", "needs a crack that grows, but the fault is not a crack",
                     "use kind = \"crack\" in [fault]");
        return;
    }
    if (study.fault.member == Member::ring) {
        draft.reject("life.interval_h",
                     "needs a crack in an external tooth (crack growth is not modelled in the "
                     "ring: fault.member)",
                     "use member = \"planet\" or \"sun\"");
        return;
    }
    if (!life.last_depth_m || !draft.usable("life.last_depth_mm")) {
        return;
    }
    check_depths(draft);
    if (!sound) {
        return;
    }
    const double largest = max_crack_depth_m(study);
    if (*life.last_depth_m >= largest) {
        draft.reject("life.last_depth_mm",
                     fmt::format("{:g} mm cuts through the tooth", 1e3 * *life.last_depth_m),
                     fmt::format("give a value below {:.6g} mm", rounded_down(1e3 * largest)));
    }
}

}  // namespace gearpod::mc
