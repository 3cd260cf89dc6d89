// Run-time choice of the instruction set for the lockstep kernels.
//
// A kernel is written once as an always-inline function template in plain C++ and is instantiated
// by GEARPOD_KERNEL for every instruction set; the processor, or a test, chooses among them at run
// time. All of them give the same bits: contraction is off and fused operations are spelled
// std::fma, which is exact with and without hardware support (a processor without FMA is slow and
// correct).
#pragma once

#include <string_view>

#define GEARPOD_INLINE inline __attribute__((always_inline))

namespace gearpod::machine {

enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

// The widest set that this processor offers.
InstructionSet best_instruction_set();

// The set that kernels use now; best_instruction_set() unless use_instruction_set() chose another.
InstructionSet active_instruction_set();

// Chooses the set for all threads. Throws std::invalid_argument if the processor lacks it.
void use_instruction_set(InstructionSet set);

// "baseline", "x86-64-v3" or "x86-64-v4".
std::string_view name(InstructionSet set);

// Throws std::logic_error: a kernel was called whose width the program was built without.
[[noreturn]] void throw_spare();

}  // namespace gearpod::machine

// GEARPOD_KERNEL(march, (State& s, int n), (s, n), march_steps<8>(s, n))
// defines void march(State&, int), which runs the last argument built for the active instruction
// set.
// GEARPOD_NARROW_KERNEL: the same for kernels of one lane, or of four, which fill a 256-bit
// register: wider registers cannot help either.
// GEARPOD_SPARE_KERNEL: a narrow one whose width a build for one processor does without
// (GEARPOD_ONLY_X86_64_V4 and the like, which the build sets): it throws there.
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
#    define GEARPOD_SPARE_KERNEL(NAME, PARAMETERS, ARGUMENTS, ...) \
        void NAME PARAMETERS {                                     \
            static_cast<void>(noexcept(__VA_ARGS__));              \
            gearpod::machine::throw_spare();                       \
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
#if !defined(GEARPOD_SPARE_KERNEL)
#    define GEARPOD_SPARE_KERNEL GEARPOD_NARROW_KERNEL
#endif
