// Choice among the kernels that this program was built with.
#pragma once

#include <optional>

#include "lockstep/kernels/kernel_table.hpp"

namespace gearpod::lockstep {

// Sets the instruction set of the kernels for all threads: the requested one, otherwise the widest
// that both program and processor support. Throws std::invalid_argument if either does not support
// it.
void choose_instruction_set(std::optional<machine::InstructionSet> requested);

// Smallest available number of lanes that holds this many gearboxes, or the largest available one.
int lanes_for(Precision precision, int gearboxes);

// Throws MissingKernel if the program has no kernels with this many lanes.
void check_lanes(Precision precision, int lanes);

}  // namespace gearpod::lockstep
