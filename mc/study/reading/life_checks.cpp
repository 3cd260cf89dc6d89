// Checks of lives: the crack, its depths, and that records remain after the baseline.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "machine/contracts.hpp"
#include "mc/study/faults/crack.hpp"
#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {

namespace {

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
