// Checks of lives: the crack, its depths, and that records remain after the baseline.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "mc/study/faults/crack_angle.hpp"
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
        draft.reject(
            "life.curve_depth_mm",
            fmt::format("{} depths at {} hours", life.curve_depth_m.size(), life.curve_h.size()),
            "give two or more, one an hour of curve_h");
    } else if (life.curve_h.front() != 0.0) {
        draft.reject("life.curve_h", fmt::format("begins at {:g} h", life.curve_h.front()),
                     "begin at 0, when the crack is there");
    } else if (life.curve_depth_m.back() < *life.last_depth_m) {
        draft.reject("life.curve_depth_mm",
                     fmt::format("ends at {:g} mm, above last_depth_mm, {:g} mm, no life",
                                 1e3 * life.curve_depth_m.back(), 1e3 * *life.last_depth_m),
                     "go on to the depth at which lives end");
    }
}

void check_loads(StudyDraft& draft) {
    const Study& study = draft.study;
    const Life& life = study.life;
    const auto check = [&](const char* key, const std::optional<int>& marched,
                           RecordQuantity quantity, double scatter) {
        const bool by_law = std::ranges::any_of(study.random, [&](const RandomInput& input) {
            return input.distribution.per_record() && record_quantity(input.key) == quantity;
        });
        if (marched && scatter == 0.0 && !by_law) {
            draft.reject(
                std::string("life.marched_") + key + "s",
                fmt::format("records have one {}, which is marched", key),
                fmt::format("leave it out, or let records' {0} vary (life.{0}_scatter)", key));
        }
    };
    check("torque", life.marched_torques, RecordQuantity::torque, life.torque_scatter);
    check("speed", life.marched_speeds, RecordQuantity::speed, life.speed_scatter);
}

// A baseline of too few records has no scatter estimate, and own_deviations() are then NaN.
void check_watch(StudyDraft& draft) {
    const Life& life = draft.study.life;
    const Monitoring& watch = draft.study.monitoring;
    const int least = watch.torque_regression ? 4 : 3;
    if (watch.baseline_records > 0 && watch.baseline_records < least) {
        draft.reject("monitoring.baseline_records",
                     fmt::format("{} of a gearbox's records do not say how they scatter{}",
                                 watch.baseline_records,
                                 watch.torque_regression ? " along a line in the torque" : ""),
                     fmt::format("take {} or more, or 0 for features as they are", least));
    }
    const double most = 1000.0 / *life.interval_h;
    if (watch.false_alarms_per_1000_h >= most) {
        draft.reject("monitoring.false_alarms_per_1000_h",
                     fmt::format("{:g} are an alarm or more in every record of a healthy gearbox "
                                 "(life.interval_h)",
                                 watch.false_alarms_per_1000_h),
                     fmt::format("it must be below {:.6g}", most));
    }
}

}  // namespace

// Runs only on a study without other problems, whose fault and teeth are valid.
void check_life(StudyDraft& draft) {
    const Study& study = draft.study;
    const Life& life = study.life;
    if (!draft.problems.empty() || !life.interval_h) {
        return;
    }
    if (study.fault.kind == nullptr || study.fault.kind->name() != "crack") {
        draft.reject("life.interval_h", "follows cracks that grow, and the fault is none",
                     "use kind = \"crack\" in [fault]");
        return;
    }
    if (study.fault.member == Member::ring) {
        draft.reject("life.interval_h",
                     "follows cracks in external teeth, which bend as beams (fault.member)",
                     "use member = \"planet\" or \"sun\"");
    }
    check_curve(draft);
    check_loads(draft);
    check_watch(draft);
    if (draft.problems.empty() && crack_begin_m(life) >= *life.last_depth_m) {
        draft.reject(life.curve_h.empty() ? "life.first_depth_mm" : "life.curve_depth_mm",
                     fmt::format("{:g} mm is not below last_depth_mm, {:g} mm",
                                 1e3 * crack_begin_m(life), 1e3 * *life.last_depth_m),
                     "begin with a shallower crack");
    }
    if (life.record_s && life.record_turns) {
        draft.reject("life.record_turns", "given beside record_s", "give one length");
    }
    const double largest = max_crack_depth_m(study);
    if (*life.last_depth_m >= largest) {
        draft.reject("life.last_depth_mm",
                     fmt::format("{:g} mm cuts the tooth", 1e3 * *life.last_depth_m),
                     fmt::format("it must be below {:.6g} mm", shown(1e3 * largest)));
    }
    if (study.ensemble.threshold_records > 1) {
        draft.reject("ensemble.threshold_records", "is for single records (life.interval_h)",
                     "leave it out; a life has life.records");
    }
    if (life.records <= study.monitoring.baseline_records) {
        draft.reject("life.records",
                     fmt::format("{} are no more than monitoring.baseline_records, {}",
                                 life.records, study.monitoring.baseline_records),
                     "raise records");
    }
}

}  // namespace gearpod::mc
