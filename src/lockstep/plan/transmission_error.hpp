// Static transmission error of gear pairs: what the flanks, unloaded, deviate from perfect ones,
// as a gap along the line of action (dynamics/effects/mesh_law.hpp).
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"
#include "stiffness/loaded_mesh.hpp"

namespace gearpod::lockstep {

// The error that repeats every mesh period,
//     e(x) = sum over h >= 1 of amplitude[h-1] sin(2 pi h x + phase[h-1]),
// x in mesh periods since the pair was at its pitch point. So it shifts with the pair's mesh phase,
// and runs backwards where contact does. Missing phases are 0.
struct MeshError {
    std::vector<double> amplitude_m;
    std::vector<double> phase_rad;
};

// Error, m, and rate, m per mesh period.
struct ErrorValue {
    double error = 0.0, rate = 0.0;
};
ErrorValue error_at(const MeshError& error, double x);

// Adds the pairs' errors, one each, to the nodes' columns.
void add_errors(const PairSet& pairs, const PhaseGrid& grid, std::span<const MeshError> errors,
                StiffnessNodes& nodes);

// The same of relieved flanks under the load they are given with, one each.
void add_relief(const PairSet& pairs, const PhaseGrid& grid,
                std::span<const stiffness::LoadedMesh* const> loaded, StiffnessNodes& nodes);

}  // namespace gearpod::lockstep
