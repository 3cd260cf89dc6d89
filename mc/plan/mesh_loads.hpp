// Nominal load of each mesh of a study: tooth stresses and deflection, and warnings of torques that
// cannot be meant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/gears.hpp"
#include "stiffness/iso_6336.hpp"

namespace gearpod::mc {

// Load of one gear pair of a mesh at the nominal torque, shared evenly by the planets.
struct MeshLoad {
    MeshMembers members;
    double force_N = 0.0;                          // along the line of action
    std::optional<stiffness::ToothStress> stress;  // empty without face width, material or flanks
    // Force over the mean mesh stiffness: the given one, or that of ISO 6336-1.
    double deflection_m = 0.0;
    bool stiffness_of_iso = false;
    double error_m = 0.0;  // of both gears' teeth, upper estimate
};

// Loads of the meshes of a study with gears.
std::vector<MeshLoad> mesh_loads(const Study& study);

// Text of a load's stresses, force and deflection.
std::string load_text(const MeshLoad& load);

// Warnings of a torque that no gear steel withstands, or that leaves the teeth nearly unloaded: at
// most one each, for the most affected mesh. Each is a notice about the study named `file`.
Problems load_warnings(const Study& study, const std::string& file);

}  // namespace gearpod::mc
