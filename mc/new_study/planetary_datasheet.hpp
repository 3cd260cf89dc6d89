// Datasheet of a planetary gearbox.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

// In the units of a datasheet. What is not given follows by rule or from the geometry.
struct PlanetaryDatasheet {
    int sun = 0, planet = 0;
    std::optional<int> ring;  // teeth; by default what standard gears need, sun + 2 planet
    int planets = 3;
    double module_mm = 0;  // normal
    double helix_deg = 0, pressure_angle_deg = 20;
    std::optional<double> face_width_mm;
    std::optional<double> addendum;  // over the normal module
    std::optional<double> sun_shift, planet_shift, ring_shift, centre_distance_mm;
    std::optional<double> sun_tip_mm, planet_tip_mm, ring_tip_mm;  // diameters
    double quality = 6;                                            // ISO 1328 grade
    std::string input = "sun";                                     // or "carrier"
    // Of the input; two of the three are needed.
    std::optional<double> torque_N_m, speed_rpm, power_kW;
};

}  // namespace gearpod::mc
