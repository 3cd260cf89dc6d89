// Arithmetic operations and bytes of a step of one gearbox.
#pragma once

#include "counted.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::bench {

// Of a step of the classical Runge-Kutta method with its sensor's filter, without a fault's
// passage; counted by running the step's template on numbers that count. Of a planetary gearbox
// with linear meshes; torsional, or with inertial terms.
Operations rk4_operations(const lockstep::MarchPlan& plan);
// Likewise of central differences, of a step that begins at no sample if there is one.
Operations central_difference_operations(const lockstep::MarchPlan& plan);

// The same of the generalized-alpha method, on a step at whose start no stiffness jumps; by the
// lists of matrix entries that its kernel goes through.
Operations generalized_alpha_operations(const lockstep::MarchPlan& plan,
                                        const dynamics::GearboxInputs& inputs);

// Bytes that a tile's step streams from and to memory beyond its own scratch: stiffness and damping
// at the stage nodes, read; the mean of a mesh period's records, written.
double bytes_streamed(const lockstep::MarchPlan& plan, int lanes);
// Bytes that it goes over again and again: motion, filter, their scratch, the lanes' parameters.
double bytes_of_tile(const lockstep::MarchPlan& plan, int lanes, int bytes_of_number);

}  // namespace gearpod::bench
