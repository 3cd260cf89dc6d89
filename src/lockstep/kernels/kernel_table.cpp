#include "lockstep/kernels/kernel_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lockstep/integrators/facts.hpp"

namespace gearpod::lockstep {
namespace {

// Largest numbers of lanes for each precision; they fill the registers of AVX-512.
constexpr int kMaxDoubleLanes = 8, kMaxSingleLanes = 16;

bool fills_registers(const KernelKey& key) {
    return key.lanes ==
           (key.precision == Precision::double_precision ? kMaxDoubleLanes : kMaxSingleLanes);
}

std::string text_of(const std::vector<int>& lanes) {
    std::string text;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        const bool last = i + 1 == lanes.size();
        text += fmt::format("{}{}", i == 0 ? "" : last ? " or " : ", ", lanes[i]);
    }
    return text;
}

}  // namespace

void KernelTable::add(const KernelKey& key, const Entry& entry) {
    kernels_.insert_or_assign(key, entry);
}

std::vector<KernelKey> KernelTable::keys() const {
    std::vector<KernelKey> all;
    for (const auto& [key, entry] : kernels_) {
        all.push_back(key);
    }
    return all;
}

KernelTable::Function KernelTable::find(KernelKey key, std::type_index lanes) const {
    for (int set = static_cast<int>(key.set); set >= 0; --set) {
        key.set = static_cast<machine::InstructionSet>(set);
        const auto found = kernels_.find(key);
        if (found == kernels_.end()) {
            continue;
        }
        if (found->second.lanes != lanes) {
            throw std::logic_error("kernel requested for an unsupported number of lanes");
        }
        return found->second.kernel;
    }
    throw MissingKernel(fmt::format(
        "this build has no {} kernel for {} {}-precision lanes (built: {})", name(key.integrator),
        key.lanes, key.precision == Precision::double_precision ? "double" : "single",
        built_kernels()));
}

const KernelTable& kernel_table() {
    static const KernelTable table = [] {
        KernelTable all;
        for (const KernelAdder add : kernel_adders()) {
            add(all);
        }
        return all;
    }();
    return table;
}

std::vector<machine::InstructionSet> built_instruction_sets() {
    std::set<machine::InstructionSet> sets;
    for (const KernelKey& key : kernel_table().keys()) {
        if (fills_registers(key)) {
            sets.insert(key.set);
        }
    }
    return {sets.begin(), sets.end()};
}

std::vector<int> built_lanes(Precision precision) {
    std::set<int> lanes;
    for (const KernelKey& key : kernel_table().keys()) {
        if (key.precision == precision) {
            lanes.insert(key.lanes);
        }
    }
    return {lanes.begin(), lanes.end()};
}

std::string built_kernels() {
    std::string sets;
    for (const machine::InstructionSet set : built_instruction_sets()) {
        sets += fmt::format("{}{}", sets.empty() ? "" : ", ", machine::name(set));
    }
    return fmt::format("{} lanes in double precision, {} in single precision, for {}",
                       text_of(built_lanes(Precision::double_precision)),
                       text_of(built_lanes(Precision::single_precision)), sets);
}

void choose_instruction_set(std::optional<machine::InstructionSet> requested) {
    const std::vector<machine::InstructionSet> built = built_instruction_sets();
    const machine::InstructionSet best = machine::best_instruction_set();
    if (requested && *requested <= best && std::ranges::find(built, *requested) == built.end()) {
        throw MissingKernel(fmt::format("this build has no kernels for {} (built: {})",
                                        machine::name(*requested), built_kernels()));
    }
    if (requested) {
        return machine::use_instruction_set(*requested);
    }
    const auto above = std::ranges::upper_bound(built, best);
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
    const auto fewest = std::ranges::lower_bound(built, gearboxes);
    return fewest == built.end() ? built.back() : *fewest;
}

void check_lanes(Precision precision, int lanes) {
    const std::vector<int> built = built_lanes(precision);
    if (std::ranges::find(built, lanes) == built.end()) {
        throw MissingKernel(fmt::format("this build has no kernels for {} lanes (built: {})", lanes,
                                        built_kernels()));
    }
}

}  // namespace gearpod::lockstep
