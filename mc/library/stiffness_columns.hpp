// Curves of the gear pairs of a study over one mesh period, as columns of a table.
#pragma once

#include <vector>

#include "mc/files/signal_column.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// The mesh phase at `points` evenly spaced values (mesh periods) and the mesh stiffness (N/m): a
// column for each gear pair without a fault, and one for each faulty pair, fault size of the study
// and mesh period of the faulty tooth's engagement, for example sp1_crack_3mm_period2.
std::vector<SignalColumn> stiffness_columns(const Scene& scene, int points);

// The mesh phase and the loaded static transmission error (um) of each gear pair, without a fault.
std::vector<SignalColumn> transmission_error_columns(const Scene& scene, int points);

}  // namespace gearpod::mc
