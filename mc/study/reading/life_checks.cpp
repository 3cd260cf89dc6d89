// Checks of a life: what grows, between which depths, and that records are left behind the
// baseline.
#include <fmt/format.h>

#include "mc/study/faults/crack_angle.hpp"
#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {

// Only on a study that is sound otherwise: its fault and teeth are then what they are.
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
    if (*life.first_depth_m >= *life.last_depth_m) {
        draft.reject("life.first_depth_mm",
                     fmt::format("{:g} mm is not below last_depth_mm, {:g} mm",
                                 1e3 * *life.first_depth_m, 1e3 * *life.last_depth_m),
                     "begin with a shallower crack");
    }
    const double largest = max_crack_depth_m(study);
    if (*life.last_depth_m >= largest) {
        draft.reject("life.last_depth_mm",
                     fmt::format("{:g} mm cuts the tooth", 1e3 * *life.last_depth_m),
                     fmt::format("it must be below {:.6g} mm", shown(1e3 * largest)));
    }
    if (life.records <= study.monitoring.baseline_records) {
        draft.reject("life.records",
                     fmt::format("{} are no more than monitoring.baseline_records, {}",
                                 life.records, study.monitoring.baseline_records),
                     "raise records");
    }
}

}  // namespace gearpod::mc
