// Variable excitation of a study's gearboxes: torque and speed fluctuations, and gravity.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// True if any gearbox has this component. A component that is 0 in every gearbox counts as absent.
bool torque_fluctuates(const Study& study);
bool speed_has_sine(const Study& study);
bool speed_has_noise(const Study& study);
inline bool speed_fluctuates(const Study& study) {
    return speed_has_sine(study) || speed_has_noise(study);
}
inline bool has_random_fluctuations(const Study& study) {
    return torque_fluctuates(study) || speed_has_noise(study);
}

// True if the planets' weights balance each other about the carrier's axis, so that a purely
// torsional model does not respond to them. True without planets.
bool planets_balance(const Study& study);

// True if weight rotates in the frame of a turning carrier.
bool gravity_turns(const Study& study);

inline bool has_variable_excitation(const Study& study) {
    return torque_fluctuates(study) || speed_fluctuates(study) || study.effects.gravity;
}
// Reason why mesh periods are not identical, e.g. "the torque fluctuates"; empty if there is none.
std::string reason_not_periodic(const Study& study);
// Reason why the motion cannot be superposed from the effects of each gear's tooth errors; empty if
// it can as long as no tooth pair loses contact.
std::string reason_not_superposed(const Study& study);

}  // namespace gearpod::mc
