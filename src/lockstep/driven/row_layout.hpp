// What a row of an excitation's values at a stage node holds (excitation_rows.hpp).
#pragma once

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// What a row holds after its columns, if the speed fluctuates: seconds a mesh period, the speed
// over its mean, and how fast that changes, 1/s.
enum PaceValue { pace_period, pace_speed, pace_change, pace_values };

// Forces that an excitation applies (DrivenForces), and values in a row: these, and a pace.
int columns_in(const Excitation& excitation);
int values_in_row(const Excitation& excitation);

// Stage nodes a step, the last of which is the next step's first if both exist.
int distinct_nodes_per_step(const PhaseGrid& grid);

}  // namespace gearpod::lockstep
