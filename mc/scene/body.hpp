// Dynamic model of a study's gearbox at rest: degrees of freedom, masses, springs and dampers.
// Speed and load are set by Drive (drivetrain.hpp).
#pragma once

#include "dynamics/gearbox.hpp"
#include "mc/scene/instance_inputs.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Model options of a study. Also valid for planetary gearboxes without teeth, for which only
// vibration modes are defined.
dynamics::GearboxLayout gearbox_layout(const Study& study);

// Inputs of one gearbox of that layout; speed and load are left at zero.
dynamics::GearboxInputs body_inputs(const Study& study, const InstanceInputs& instance);

}  // namespace gearpod::mc
