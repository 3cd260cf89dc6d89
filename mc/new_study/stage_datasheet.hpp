// Datasheet values common to planetary stages and gear pairs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gearpod::mc {

// Values in the usual units. Missing ones follow from rules of thumb or the geometry.
struct StageDatasheet {
    double module_mm = 0;  // normal
    double helix_deg = 0, pressure_angle_deg = 20;
    std::optional<double> face_width_mm;
    std::optional<double> addendum;  // divided by the normal module
    std::optional<double> centre_distance_mm;
    std::optional<double> young_modulus_Pa, poisson_ratio;
    double quality = 6;  // ISO 1328 grade
    // Torque, speed and power of the driving member; exactly two of the three.
    std::optional<double> torque_N_m, speed_rpm, power_kW;
    std::string origin = "datasheet";  // kind of document, for the study's first comment
    std::vector<std::string> notes;    // further comments at the head of the study
};

}  // namespace gearpod::mc
