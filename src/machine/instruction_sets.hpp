// Run-time choice of the instruction set of the kernels (machine/instruction_sets.hpp).
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

// Kernels compiled for several instruction sets.
//
// A kernel is an always-inline function in plain C++, written once. All instruction sets give the
// same bits: contraction is off, and fused operations are spelled std::fma, which is exact with and
// without hardware support. A processor without FMA is slow but correct.
//
// A build for one processor or with sanitizers defines GEARPOD_KERNEL_SET, the one instruction set
// for which run_kernel() compiles its kernels.

#if defined(__clang__)
#    define GEARPOD_X86_64_V4 "arch=x86-64-v4"
#else
#    define GEARPOD_X86_64_V4 "arch=x86-64-v4,prefer-vector-width=512"
#endif

namespace gearpod::machine {

template <auto kKernel>
struct Compiled;

// The kernel as a function for each instruction set.
template <class... Arguments, void (*kKernel)(Arguments...)>
struct Compiled<kKernel> {
#if defined(__x86_64__)
    __attribute__((target(GEARPOD_X86_64_V4))) static void x86_64_v4(Arguments... arguments) {
        kKernel(arguments...);
    }
    __attribute__((target("arch=x86-64-v3"))) static void x86_64_v3(Arguments... arguments) {
        kKernel(arguments...);
    }
#endif
    static void baseline(Arguments... arguments) {
        kKernel(arguments...);
    }

    // Function of the set; baseline on other processors.
    template <InstructionSet kSet>
    static constexpr auto of() -> void (*)(Arguments...) {
#if defined(__x86_64__)
        if constexpr (kSet == InstructionSet::x86_64_v4) {
            return x86_64_v4;
        }
        if constexpr (kSet == InstructionSet::x86_64_v3) {
            return x86_64_v3;
        }
#endif
        return baseline;
    }
};

// Runs the kernel compiled for the active instruction set. Called in files *_kernel.cpp only, which
// the build compiles with the options of kernels.
template <auto kKernel, class... Arguments>
void run_kernel(Arguments&&... arguments) {
    using Sets = Compiled<kKernel>;
#if defined(GEARPOD_KERNEL_SET)
    Sets::template of<InstructionSet::GEARPOD_KERNEL_SET>()(arguments...);
#else
    switch (active_instruction_set()) {
        case InstructionSet::x86_64_v4:
            return Sets::template of<InstructionSet::x86_64_v4>()(arguments...);
        case InstructionSet::x86_64_v3:
            return Sets::template of<InstructionSet::x86_64_v3>()(arguments...);
        case InstructionSet::baseline:
            return Sets::template of<InstructionSet::baseline>()(arguments...);
    }
#endif
}

// True if this build has kernels for this number of lanes. A build for one processor has only those
// that fill its registers: its programs do not use the others, and they take long to compile.
template <int W>
constexpr bool has_kernels_of_lanes() {
#if defined(GEARPOD_KERNEL_SET)
    return W >= 8 || InstructionSet::GEARPOD_KERNEL_SET == InstructionSet::baseline;
#else
    return true;
#endif
}

// Calls task.operator()<W>() for this number of lanes, at most kMost. Throws std::logic_error if
// there are no such kernels or this build lacks them.
template <int kMost, class Task>
void with_lanes(int lanes, Task task) {
    if constexpr (has_kernels_of_lanes<kMost>()) {
        if (lanes == kMost) {
            return task.template operator()<kMost>();
        }
    }
    if constexpr (kMost == 1) {
        throw_kernel_not_built(lanes);
    } else {
        with_lanes<kMost == 4 ? 1 : kMost / 2>(lanes, task);
    }
}

}  // namespace gearpod::machine
