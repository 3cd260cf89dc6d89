// Datasheet of a gear pair on fixed shafts.
#pragma once

#include <optional>

#include "mc/new_study/stage_datasheet.hpp"

namespace gearpod::mc {

// Datasheet values in the usual units. The pinion drives the gear and may be the larger of the two.
struct PairDatasheet : StageDatasheet {
    int pinion = 0, gear = 0;  // teeth
    std::optional<double> pinion_shift, gear_shift;
    std::optional<double> pinion_tip_mm, gear_tip_mm;            // diameters
    std::optional<double> pinion_bearing_N_m, gear_bearing_N_m;  // radial stiffness
};

}  // namespace gearpod::mc
