// Simulates one gearbox of a study with all its signals.
#pragma once

#include <string>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct Simulation {
    std::vector<SignalColumn> columns;
    std::vector<RowColumn> contact_loss;  // over the mesh periods of the signals
    std::vector<double> noise_levels;
    std::vector<std::string> feature_names;
    std::vector<double> features;  // [feature * levels + level], as in a results file
};

// Simulates the first `meshes` mesh periods of the gearbox's record, which begins at mesh phase 0
// unless the study gives the length of records. Throws std::runtime_error if the gearbox fails.
Simulation simulate(const TilePlan& plan, const GearboxId& id, long meshes);

}  // namespace gearpod::mc
