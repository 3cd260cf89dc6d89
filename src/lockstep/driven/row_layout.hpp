// Layout of a row of excitation values at a stage node (excitation_rows.hpp).
#pragma once

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Values after a row's columns if the speed fluctuates: seconds per mesh period, speed relative to
// its mean, and the rate of change of that, 1/s.
enum PaceValue { pace_period, pace_speed, pace_change, pace_values };

// Number of force patterns of an excitation (DrivenForces), and number of values in a row: these
// plus the speed values.
int columns_in(const Excitation& excitation);
int values_in_row(const Excitation& excitation);

// Distinct stage nodes per step: a node at the end of a step counts as the first one of the next
// step if both exist.
int distinct_nodes_per_step(const PhaseGrid& grid);

}  // namespace gearpod::lockstep
