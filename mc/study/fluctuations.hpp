// What drives a study's gearboxes unevenly.
#pragma once

#include "mc/study/study.hpp"

namespace gearpod::mc {

// A part that is 0 in every gearbox counts as absent.
bool torque_has_sine(const Study& study);
bool torque_has_noise(const Study& study);
bool speed_has_sine(const Study& study);
bool speed_has_noise(const Study& study);
inline bool torque_fluctuates(const Study& study) {
    return torque_has_sine(study) || torque_has_noise(study);
}
inline bool speed_fluctuates(const Study& study) {
    return speed_has_sine(study) || speed_has_noise(study);
}
inline bool draws_fluctuations(const Study& study) {
    return torque_has_noise(study) || speed_has_noise(study);
}

// Planets whose weights balance each other about the carrier's axis: a train of rotations alone
// feels nothing of them. True without planets.
bool planets_balance(const Study& study);

// Weight that turns in the frame of a turning carrier.
bool gravity_turns(const Study& study);

inline bool driven_unevenly(const Study& study) {
    return torque_fluctuates(study) || speed_fluctuates(study) || study.effects.gravity;
}
// Why no mesh repeats the one before, as "the torque fluctuates"; empty if nothing of this prevents
// it.
std::string why_no_mesh_repeats(const Study& study);
// Why its meshes cannot be superposed of what the teeth of each gear do; empty if they can where no
// tooth pair loses contact.
std::string why_not_superposed(const Study& study);

}  // namespace gearpod::mc
