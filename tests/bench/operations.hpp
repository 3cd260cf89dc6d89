// Number of arithmetic operations and bytes of one time step of one realization.
#pragma once

#include "counted.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::bench {

// Operations of one step of the classical Runge-Kutta method with its sensor filter and without a
// fault's passage, counted by running the step's template on counting numbers. Requires a planetary
// gearbox with linear meshes, torsional or with inertial terms.
Operations rk4_operations(const lockstep::IntegrationPlan& plan);
// Operations of one step of central differences; the step begins at no sample if samples are
// further apart.
Operations central_difference_operations(const lockstep::IntegrationPlan& plan);

// Bytes per step of a tile streamed from and to memory outside its own scratch: stiffness and
// damping at the stage nodes are read, the mean of a mesh period's records is written.
double bytes_streamed(const lockstep::IntegrationPlan& plan, int lanes);
// Bytes of a tile that are used in every step: state, filter, their scratch, the lanes' parameters.
double bytes_of_tile(const lockstep::IntegrationPlan& plan, int lanes, int bytes_of_number);

}  // namespace gearpod::bench
