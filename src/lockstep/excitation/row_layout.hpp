// Layout of a row of excitation values at a stage node (excitation_rows.hpp).
#pragma once

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::lockstep {

// Values after a row's columns if the speed fluctuates: seconds per mesh period, speed relative to
// its mean, and the rate of change of that, 1/s.
enum SpeedValue { mesh_period_value, relative_speed_value, speed_rate_value, speed_value_count };

// Number of force patterns of an excitation (ExcitationForces), and number of values in a row:
// these plus the speed values.
int columns_in(const Excitation& excitation);
int values_in_row(const Excitation& excitation);

// Distinct stage nodes per step: a node at the end of a step counts as the first one of the next
// step if both exist.
int distinct_nodes_per_step(const PhaseGrid& grid);

}  // namespace gearpod::lockstep
