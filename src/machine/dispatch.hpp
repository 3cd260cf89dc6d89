// Run-time choice of the instruction set of the kernels (machine/kernel.hpp).
#pragma once

#include <string_view>

#define GEARPOD_INLINE inline __attribute__((always_inline))

namespace gearpod::machine {

enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

// Widest instruction set of this processor.
InstructionSet best_instruction_set();

// Instruction set that kernels use now: best_instruction_set() unless use_instruction_set() chose
// another.
InstructionSet active_instruction_set();

// Chooses the instruction set for all threads. Throws std::invalid_argument if the processor lacks
// it.
void use_instruction_set(InstructionSet set);

// Name of the set: "baseline", "x86-64-v3" or "x86-64-v4".
std::string_view name(InstructionSet set);

// Throws std::logic_error: this build has no kernels for this number of lanes.
[[noreturn]] void throw_kernel_not_built(int lanes);

}  // namespace gearpod::machine
