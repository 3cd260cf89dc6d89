#include "machine/instruction_sets.hpp"

#include <atomic>
#include <stdexcept>
#include <string>

namespace gearpod::machine {
namespace {

std::atomic<InstructionSet>& active() {
    static std::atomic<InstructionSet> set{best_instruction_set()};
    return set;
}

}  // namespace

InstructionSet best_instruction_set() {
#if defined(__x86_64__)
    // Levels of the x86-64 psABI, tested by the features that gcc's x86-64-v3 and -v4 may use.
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    if (v4) {
        return InstructionSet::x86_64_v4;
    }
    if (v3) {
        return InstructionSet::x86_64_v3;
    }
#endif
    return InstructionSet::baseline;
}

InstructionSet active_instruction_set() {
    return active().load(std::memory_order_relaxed);
}

void use_instruction_set(InstructionSet set) {
    if (set > best_instruction_set()) {
        throw std::invalid_argument("this processor lacks " + std::string(name(set)));
    }
    active().store(set, std::memory_order_relaxed);
}

void throw_kernel_not_built(int lanes) {
    throw std::logic_error("this build has no kernels for " + std::to_string(lanes) + " lanes");
}

std::string_view name(InstructionSet set) {
    switch (set) {
        case InstructionSet::x86_64_v4:
            return "x86-64-v4";
        case InstructionSet::x86_64_v3:
            return "x86-64-v3";
        case InstructionSet::baseline:
            break;
    }
    return "baseline";
}

}  // namespace gearpod::machine
