// Vibration of other sources in the records of a gearbox: faulty bearings and neighbouring stages.
#pragma once

#include <span>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Vibration of the background sources in records of that many mesh periods of these gearboxes, one
// per lane, before the sensors' measuring chains; empty without such sources. Coupled stages have
// vibrated with the gearbox (LaneSignals::coupled); other stages are integrated here. Samples count
// as evenly spaced even if the speed fluctuates. A record next to whose gearbox a stage fails
// becomes NaN.
std::vector<std::vector<double>> background_vibration(const TilePlan& plan,
                                                      std::span<const Realization> realizations,
                                                      std::span<const LaneSignals> records,
                                                      int meshes);
// The whole records of these gearboxes, with their background, and with the other fault in the
// samples of the first sensor; empty without sources of another fault.
std::vector<LaneSignals> with_other_fault(const TilePlan& plan,
                                          std::span<const Realization> realizations,
                                          std::span<const LaneSignals> records);

}  // namespace gearpod::mc
