// Text of a planetary gearbox's study file.
#pragma once

#include <map>
#include <string>

#include "gears/power_flow.hpp"
#include "mc/new_study/datasheet_problems.hpp"
#include "mc/new_study/planetary_datasheet.hpp"
#include "mc/new_study/rules.hpp"

namespace gearpod::mc {

// Datasheet completed with the ring's tooth number and the face width.
struct NominalGears {
    PlanetaryDatasheet data;
    int ring_teeth = 0;
    double face_width_mm = 0;
};

// Values derived by the rules of rules.hpp.
struct DerivedGearbox {
    double centre_distance_m = 0;
    Annulus sun_body, planet_body, ring_body;
    RollerBearing bearing;  // of a planet
    // Stiffness of bearings and support, given or by rule: sun, planet, ring, carrier, support.
    std::map<std::string, double> bearings_N_m;
    double carrier_mass_kg = 0, carrier_inertia_kg_m2 = 0;
    gears::CentralMembers torques;
    double mesh_frequency_Hz = 0, pin_load_N = 0, deepest_crack_m = 0;
};

// Returns section [gearbox] with the datasheet values and the material.
std::string gearbox_teeth(const NominalGears& gears);

// Returns the complete study. `command`: command line, quoted in its first comment.
std::string planetary_text(const NominalGears& gears, const DerivedGearbox& derived,
                           const InputLoad& load, const std::string& command);

}  // namespace gearpod::mc
