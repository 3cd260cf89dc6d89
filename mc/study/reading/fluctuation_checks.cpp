#include <fmt/format.h>

#include "mc/study/fluctuations.hpp"
#include "mc/study/reading/parts.hpp"

namespace gearpod::mc {
namespace {

void check_torque_sine(StudyDraft& draft) {
    const std::string key = "operation.torque_fluctuation";
    const std::string order = key + "_order", frequency = key + "_Hz";
    if (!draft.is_given(key) || !draft.all_usable({key, order, frequency})) {
        return;
    }
    if (draft.is_given(order) && draft.is_given(frequency)) {
        draft.reject(frequency,
                     fmt::format("conflicts with {} (both give how fast it varies)", order),
                     "remove one of them");
    } else if (!draft.is_given(order) && !draft.is_given(frequency)) {
        draft.reject(key, "needs a frequency",
                     "add torque_fluctuation_order or torque_fluctuation_Hz");
    }
}

void check_gravity(StudyDraft& draft) {
    const Study& s = draft.study;
    if (s.effects.gravity && s.effects.torsional() && planets_balance(s) &&
        draft.all_usable({"gearbox.kind", "gearbox.planet_positions_deg", "effects.motion",
                          "effects.gravity"}) &&
        s.gearbox.kind == GearboxKind::planetary) {
        draft.reject("effects.gravity",
                     "would have no effect (in a torsional model only the planets' weights act, "
                     "and they balance each other about the carrier's axis: effects.motion)",
                     "remove it, or use a motion in x and y");
    }
}

}  // namespace

void check_fluctuations(StudyDraft& draft) {
    check_torque_sine(draft);
    check_gravity(draft);
}

}  // namespace gearpod::mc
