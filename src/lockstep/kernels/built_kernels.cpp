#include "lockstep/kernels/built_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearpod::lockstep {

void choose_instruction_set(std::optional<machine::InstructionSet> requested) {
    const std::vector<machine::InstructionSet> built = built_instruction_sets();
    const machine::InstructionSet best = machine::best_instruction_set();
    if (requested && *requested <= best &&
        std::find(built.begin(), built.end(), *requested) == built.end()) {
        throw MissingKernel(fmt::format("this build has no kernels for {} (built: {})",
                                        machine::name(*requested), built_kernels()));
    }
    if (requested) {
        return machine::use_instruction_set(*requested);
    }
    const auto above = std::upper_bound(built.begin(), built.end(), best);
    if (above == built.begin()) {
        throw MissingKernel(
            fmt::format("this program was built for {}, and this processor has {}: build "
                        "it here, or for all (preset portable)",
                        machine::name(built.front()), machine::name(best)));
    }
    machine::use_instruction_set(*(above - 1));
}

int lanes_for(Precision precision, int gearboxes) {
    const std::vector<int> built = built_lanes(precision);
    const auto fewest = std::lower_bound(built.begin(), built.end(), gearboxes);
    return fewest == built.end() ? built.back() : *fewest;
}

void check_lanes(Precision precision, int lanes) {
    const std::vector<int> built = built_lanes(precision);
    if (std::find(built.begin(), built.end(), lanes) == built.end()) {
        throw MissingKernel(fmt::format("this build has no kernels for {} lanes (built: {})", lanes,
                                        built_kernels()));
    }
}

}  // namespace gearpod::lockstep
