// The dynamic model of a study's gearbox at rest: its degrees of freedom, masses, springs and
// dampers. Speed and load come with the drive (drive.hpp).
#pragma once

#include "dynamics/gearbox.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// The model's choices; also for planetary gearboxes without teeth, of which modes are defined.
dynamics::GearboxLayout gearbox_layout(const Study& study);

// One gearbox of that layout; speed and load are left at zero.
dynamics::GearboxInputs body_inputs(const Study& study, const InstanceInputs& instance);

}  // namespace gearpod::mc
