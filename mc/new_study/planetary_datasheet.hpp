// Datasheet of a planetary gearbox.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

// Datasheet values in the usual units. Missing values follow from rules of thumb or the geometry.
struct PlanetaryDatasheet {
    int sun = 0, planet = 0;
    std::optional<int> ring;  // teeth; default for standard gears: sun + 2 planet
    int planets = 3;
    double module_mm = 0;  // normal
    double helix_deg = 0, pressure_angle_deg = 20;
    std::optional<double> face_width_mm;
    std::optional<double> addendum;  // divided by the normal module
    std::optional<double> sun_shift, planet_shift, ring_shift, centre_distance_mm;
    std::optional<double> sun_tip_mm, planet_tip_mm, ring_tip_mm;  // diameters
    double quality = 6;                                            // ISO 1328 grade
    std::string input = "sun";                                     // or "carrier"
    // Torque, speed and power of the input; exactly two of the three.
    std::optional<double> torque_N_m, speed_rpm, power_kW;
};

}  // namespace gearpod::mc
