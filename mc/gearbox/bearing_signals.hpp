// Vibration of a study's faulty bearings in the records of a gearbox.
#pragma once

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/study/bearings.hpp"
#include "signals/noise/bearing_impulses.hpp"

namespace gearpod::mc {

// Impulses of one of the study's bearings in a gearbox with these inputs.
signals::BearingImpulses bearing_impulses(const Scene& scene, const InstanceInputs& inputs,
                                          const Bearing& bearing);

// Adds the bearings with that role to a record's sensor samples and folds them again. No effect
// without samples. Samples count as evenly spaced even if the speed fluctuates.
void add_bearings(const Scene& scene, const Realization& realization, BearingRole role,
                  LaneSignals& record);

}  // namespace gearpod::mc
