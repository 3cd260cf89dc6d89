#include "lockstep/fault_schedule.hpp"

#include <algorithm>

#include "dynamics/effects/mesh_damping.hpp"

namespace gearpod::lockstep {

// Where the passage that touches mesh k began, if one does: in this pattern, or in the one before.
std::optional<double> FaultSchedule::passage_start(const FaultPassage& passage, int k) const {
    const double ratio = faults_.pairs->curve(passage.pair).contact_ratio();
    for (const double from : {passage.start, passage.start - faults_.pattern.length}) {
        if (from < k + 1 && from + ratio > k) {
            return from;
        }
    }
    return std::nullopt;
}

std::vector<PairOverride> FaultSchedule::overrides(int k) const {
    std::vector<PairOverride> all;
    for (const FaultPassage& passage : faults_.pattern.passages) {
        if (const auto start = passage_start(passage, k)) {
            all.push_back(make_override(passage.pair, k, *start));
        }
    }
    return all;
}

bool FaultSchedule::continues_after(int k) const {
    return std::any_of(
        faults_.pattern.passages.begin(), faults_.pattern.passages.end(),
        [&](const FaultPassage& passage) {
            const auto start = passage_start(passage, k);
            return start && *start + faults_.pairs->curve(passage.pair).contact_ratio() > k + 1;
        });
}

// The cracked tooth in place of the healthy one, lane by lane.
PairOverride FaultSchedule::make_override(int pair, int k, double start) const {
    const auto& curve = faults_.pairs->curve(pair);
    const ToothPositions at = tooth_positions(plan_.grid, k, start, curve.contact_ratio());
    const std::size_t stages = plan_.grid.stage_nodes.size();
    const auto first = static_cast<std::size_t>(at.first_step) * stages;
    const auto count = static_cast<std::size_t>(at.last_step) * stages - first;
    const auto tau = std::span(at.tau).subspan(first, count);
    const std::size_t lanes = faults_.cracked.size();
    std::vector<double> healthy(count), cracked(count);
    const PairSet& pairs = *faults_.pairs;
    pairs.tooth_pair(curve, curve.contact_ratio(), tau, healthy);

    PairOverride o{pair, at.first_step, at.last_step, machine::AlignedVector(count * lanes),
                   machine::AlignedVector(count * lanes)};
    const auto column = [&](std::size_t i) {
        return (first + i) * static_cast<std::size_t>(plan_.nodes.pairs) +
               static_cast<std::size_t>(pair);
    };
    for (std::size_t l = 0; l < lanes; ++l) {
        if (!faults_.cracked[l]) {
            for (std::size_t i = 0; i < count; ++i) {
                o.stiffness[i * lanes + l] = plan_.nodes.stiffness[column(i)];
                o.damping_shape[i * lanes + l] = plan_.nodes.damping_shape[column(i)];
            }
            continue;
        }
        pairs.tooth_pair(*faults_.cracked[l], curve.contact_ratio(), tau, cracked);
        dynamics::with_mesh_damping(dynamics::mesh_damping(plan_.layout), [&](auto law) {
            for (std::size_t i = 0; i < count; ++i) {
                // Where the tooth carries alone, the rest is rounding: exactly nothing then.
                const double others = plan_.nodes.stiffness[column(i)] - healthy[i];
                const double k_pair = (others > 1e-9 * healthy[i] ? others : 0.0) + cracked[i];
                o.stiffness[i * lanes + l] = k_pair;
                o.damping_shape[i * lanes + l] = law.shape(k_pair);
            }
        });
    }
    return o;
}

}  // namespace gearpod::lockstep
