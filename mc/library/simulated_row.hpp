// Simulates the gearbox in a row of the results of a study.
#pragma once

#include "mc/gearbox/simulation.hpp"

namespace gearpod::mc {

// The first `meshes` mesh periods of the gearbox; 0: one planet turn. Throws BadInput
// (mc/input/bad_input.hpp) if there is no such row or too many mesh periods are requested, and
// std::runtime_error if the gearbox fails.
Simulation simulate_row(const Scene& scene, long row, long meshes = 0);

}  // namespace gearpod::mc
