// Gears, mesh geometry, materials and bearings of a stage in a REXS model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/rexs/rexs_stages.hpp"

namespace gearpod::mc {

// Values of one gear, or of equal ones; missing ones are empty. Internal gears have positive
// numbers here. Shifts follow ISO 21771.
struct RexsGear {
    const RexsComponent* component = nullptr;  // of several equal gears the first
    int teeth = 0;
    std::optional<double> module_mm, pressure_angle_deg, helix_deg, shift, face_width_mm, tip_mm;
    std::optional<double> young_modulus_Pa, poisson_ratio;
};

// Reads equal gears, such as all planets of a stage. Values that differ are problems, as are a
// missing number of teeth or module.
RexsGear rexs_gear(RexsValues& values, const std::vector<const RexsComponent*>& gears);

// Values that all gears of a stage share.
struct RexsTeeth {
    std::optional<double> module_mm, pressure_angle_deg, helix_deg, face_width_mm,
        centre_distance_mm, young_modulus_Pa, poisson_ratio;
    std::vector<std::string> notes;  // how values that differ were combined
};

// Combines the gears of a stage. Modules, pressure angles, helix angles and centre distances that
// differ are problems.
RexsTeeth rexs_teeth(RexsValues& values, const RexsStage& stage,
                     const std::vector<RexsGear>& gears);

// Rejects a centre distance that does not fit the teeth and shifts of two gears, with the one that
// does. Notes a small backlash. `internal`: gear_2 is a ring.
void check_centre_distance(RexsValues& values, const RexsComponent& pair, const RexsTeeth& teeth,
                           const RexsGear& gear_1, const RexsGear& gear_2, bool internal,
                           std::vector<std::string>& notes);

// Radial stiffness of all bearings between these shafts and other parts, N/m. Empty without
// bearings, or if any of them is rigid or has none; a note names these.
std::optional<double> rexs_bearings(RexsValues& values,
                                    const std::vector<const RexsComponent*>& shafts,
                                    const std::string& member, std::vector<std::string>& notes);

}  // namespace gearpod::mc
