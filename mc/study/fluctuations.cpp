#include "mc/study/fluctuations.hpp"

#include <cmath>

#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

bool any(const Study& study, const std::optional<double>& value, const char* key) {
    return value.value_or(0.0) > 0.0 || study.find_random(key) != nullptr;
}

}  // namespace

bool torque_fluctuates(const Study& study) {
    return any(study, study.fluctuations.torque_noise, "operation.torque_noise");
}
bool speed_has_sine(const Study& study) {
    return any(study, study.fluctuations.speed, "operation.speed_fluctuation");
}
bool speed_has_noise(const Study& study) {
    return any(study, study.fluctuations.speed_noise, "operation.speed_noise");
}

bool planets_balance(const Study& study) {
    double x = 0.0, y = 0.0;
    for (const double position : study.gearbox.planet_positions_rad) {
        x += std::cos(position);
        y += std::sin(position);
    }
    return std::hypot(x, y) < 1e-9;
}

bool gravity_turns(const Study& study) {
    return study.effects.gravity && study.gearbox.kind == GearboxKind::planetary &&
           study.operation.fixed != Member::carrier;
}

std::string reason_not_periodic(const Study& study) {
    return torque_fluctuates(study)  ? "the torque fluctuates"
           : speed_fluctuates(study) ? "the speed fluctuates"
           : gravity_turns(study)    ? "gravity rotates relative to the carrier"
           : has_tooth_errors(study) ? "every tooth has individual errors"
                                     : "";
}

std::string reason_not_superposed(const Study& study) {
    return study.effects.quasi_static()     ? "a quasi-static gearbox is not integrated in time"
           : has_variable_excitation(study) ? "torque, speed or weight varies"
           : !has_tooth_errors(study)       ? "the teeth have no individual errors"
           : study.effects.contact_onset == ContactOnset::extended
               ? "extended contact (effects.contact_onset) cannot be superposed"
               : "";
}

}  // namespace gearpod::mc
