// Datasheet of a planetary gearbox.
#pragma once

#include <optional>
#include <string>

#include "mc/new_study/stage_datasheet.hpp"

namespace gearpod::mc {

// Datasheet values in the usual units. Missing values follow from rules of thumb or the geometry.
struct PlanetaryDatasheet : StageDatasheet {
    int sun = 0, planet = 0;
    std::optional<int> ring;  // teeth; default for standard gears: sun + 2 planet
    int planets = 3;
    std::optional<double> sun_shift, planet_shift, ring_shift;
    std::optional<double> sun_tip_mm, planet_tip_mm, ring_tip_mm;  // diameters
    // Radial stiffness of the bearings of each member.
    std::optional<double> sun_bearing_N_m, planet_bearing_N_m, ring_bearing_N_m,
        carrier_bearing_N_m;
    std::string input = "sun";  // or "carrier"
};

}  // namespace gearpod::mc
