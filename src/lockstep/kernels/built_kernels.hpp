// Which of the kernels that a study may ask for this program was built with.
#pragma once

#include <optional>

#include "lockstep/kernels/kernel_table.hpp"

namespace gearpod::lockstep {

// Chooses the kernels' instruction set for all threads: the one asked for, or else the widest that
// program and processor have. Throws std::invalid_argument where either lacks it.
void choose_instruction_set(std::optional<machine::InstructionSet> asked_for);

// The fewest lanes of the program's kernels that hold so many gearboxes, or the most that it has.
int lanes_for(Precision precision, int gearboxes);

// Throws NoSuchKernel.
void check_lanes(Precision precision, int lanes);

}  // namespace gearpod::lockstep
