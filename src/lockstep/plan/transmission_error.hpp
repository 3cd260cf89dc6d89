// Static transmission error of gear pairs: deviation of the unloaded flanks from the ideal ones,
// expressed as a gap along the line of action (dynamics/effects/mesh_law.hpp).
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// Transmission error that repeats every mesh period,
//     e(x) = sum over h >= 1 of amplitude[h-1] sin(2 pi h x + phase[h-1]),
// with x in mesh periods since the pair was at its pitch point. It therefore shifts with the pair's
// mesh phase and runs backwards in reversed contact. Missing phases are 0.
struct MeshError {
    std::vector<double> amplitude_m;
    std::vector<double> phase_rad;
};

// Error, m, and its rate, m per mesh period.
struct ErrorValue {
    double error = 0.0, rate = 0.0;
};
ErrorValue error_at(const MeshError& error, double x);

// Adds the errors of all pairs (one entry per pair) to the table.
void add_errors(const PairSet& pairs, const PhaseGrid& grid, std::span<const MeshError> errors,
                StiffnessNodes& nodes);

}  // namespace gearpod::lockstep
