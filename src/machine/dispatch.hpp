// Run-time choice of the instruction set for the lockstep kernels.
//
// A kernel is written once as an always-inline function template in plain C++. GEARPOD_KERNEL
// instantiates it for every instruction set, and the processor or a test chooses one at run time.
// All instruction sets give the same bits: contraction is off, and fused operations are spelled
// std::fma, which is exact with and without hardware support. A processor without FMA is slow but
// correct.
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

// Throws std::logic_error: the called kernel's number of lanes was left out of this build.
[[noreturn]] void throw_kernel_not_built();

}  // namespace gearpod::machine

// GEARPOD_KERNEL(integrate, (State& s, int n), (s, n), integrate_steps<8>(s, n))
// defines void integrate(State&, int), which runs the last argument compiled for the active
// instruction set.
//
// GEARPOD_NARROW_KERNEL does the same for kernels of one or four lanes. Four doubles fill a 256-bit
// register, so 512-bit registers are no gain.
//
// GEARPOD_OPTIONAL_KERNEL is a narrow kernel that a build for one processor leaves out. The build
// sets GEARPOD_ONLY_X86_64_V4 or a similar macro, and the kernel throws there.
#if defined(GEARPOD_ONLY_X86_64_V4) || defined(GEARPOD_ONLY_X86_64_V3)
#    define GEARPOD_KERNEL_OF_SET(SET, TARGET, NAME, PARAMETERS, ARGUMENTS, ...) \
        namespace {                                                              \
        __attribute__((target(TARGET))) void NAME##_##SET PARAMETERS {           \
            __VA_ARGS__;                                                         \
        }                                                                        \
        }                                                                        \
        void NAME PARAMETERS {                                                   \
            return NAME##_##SET ARGUMENTS;                                       \
        }
#    define GEARPOD_NARROW_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...) \
        GEARPOD_KERNEL_OF_SET(x86_64_v3, "arch=x86-64-v3", NAME, PARAMETERS, ARGUMENTS, __VA_ARGS__)
#    define GEARPOD_OPTIONAL_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...) \
        void NAME PARAMETERS {                                        \
            static_cast<void>(noexcept(__VA_ARGS__));                 \
            gearpod::machine::throw_kernel_not_built();               \
        }
#endif
#if defined(GEARPOD_ONLY_X86_64_V4)
#    define GEARPOD_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...)                             \
        GEARPOD_KERNEL_OF_SET(x86_64_v4, "arch=x86-64-v4,prefer-vector-width=512", NAME, \
                              PARAMETERS, ARGUMENTS, __VA_ARGS__)
#elif defined(GEARPOD_ONLY_X86_64_V3)
#    define GEARPOD_KERNEL GEARPOD_NARROW_KERNEL
#elif defined(__x86_64__) && !defined(GEARPOD_ONE_INSTRUCTION_SET)
#    define GEARPOD_NARROW_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...)                  \
        namespace {                                                                  \
        __attribute__((target("arch=x86-64-v3"))) void NAME##_x86_64_v3 PARAMETERS { \
            __VA_ARGS__;                                                             \
        }                                                                            \
        void NAME##_baseline PARAMETERS {                                            \
            __VA_ARGS__;                                                             \
        }                                                                            \
        }                                                                            \
        void NAME PARAMETERS {                                                       \
            return gearpod::machine::active_instruction_set() ==                     \
                           gearpod::machine::InstructionSet::baseline                \
                       ? NAME##_baseline ARGUMENTS                                   \
                       : NAME##_x86_64_v3 ARGUMENTS;                                 \
        }
#    define GEARPOD_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...)                                      \
        namespace {                                                                               \
        __attribute__((                                                                           \
            target("arch=x86-64-v4,prefer-vector-width=512"))) void NAME##_x86_64_v4 PARAMETERS { \
            __VA_ARGS__;                                                                          \
        }                                                                                         \
        __attribute__((target("arch=x86-64-v3"))) void NAME##_x86_64_v3 PARAMETERS {              \
            __VA_ARGS__;                                                                          \
        }                                                                                         \
        void NAME##_baseline PARAMETERS {                                                         \
            __VA_ARGS__;                                                                          \
        }                                                                                         \
        }                                                                                         \
        void NAME PARAMETERS {                                                                    \
            switch (gearpod::machine::active_instruction_set()) {                                 \
                case gearpod::machine::InstructionSet::x86_64_v4:                                 \
                    return NAME##_x86_64_v4 ARGUMENTS;                                            \
                case gearpod::machine::InstructionSet::x86_64_v3:                                 \
                    return NAME##_x86_64_v3 ARGUMENTS;                                            \
                case gearpod::machine::InstructionSet::baseline:                                  \
                    return NAME##_baseline ARGUMENTS;                                             \
            }                                                                                     \
        }
#else
#    define GEARPOD_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...) \
        void NAME PARAMETERS {                               \
            __VA_ARGS__;                                     \
        }
#    define GEARPOD_NARROW_KERNEL GEARPOD_KERNEL
#endif
#if !defined(GEARPOD_OPTIONAL_KERNEL)
#    define GEARPOD_OPTIONAL_KERNEL GEARPOD_NARROW_KERNEL
#endif
