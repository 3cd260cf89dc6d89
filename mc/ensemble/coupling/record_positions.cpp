#include "mc/ensemble/coupling/record_positions.hpp"

#include <algorithm>
#include <boost/random/uniform_int_distribution.hpp>

namespace gearpod::mc {

bool share_positions(const GearboxId& a, const GearboxId& b, std::uint64_t together) {
    return a.group == b.group && a.record == b.record && a.baseline == b.baseline &&
           a.index / together == b.index / together;
}

std::size_t shared_records(const RecordPlan& record, std::span<const GearboxId> ids,
                           std::size_t most) {
    most = std::min(most, ids.size());
    if (record.same_positions == 1) {
        return most;
    }
    std::size_t count = 1;
    while (count < most && share_positions(ids[count], ids[0], record.same_positions)) {
        ++count;
    }
    return count;
}

std::vector<lockstep::SpanPart> parts_of_records(const RecordPlan& plan,
                                                 const FeaturePlan& features,
                                                 std::span<const Realization> records,
                                                 std::size_t repeats) {
    const bool compares = !features.needs.change.empty();
    // A motion that all baseline records have is cut at the window of each.
    const std::size_t copies = plan.computed_baselines == 1 ? plan.baselines : 1;
    std::vector<lockstep::SpanPart> all;
    for (const Realization& record : records) {
        const int turns = plan.turns(record.inputs);
        const int meshes = std::min(turns * plan.span.planet_teeth, plan.recorded_meshes);
        const auto add = [&](GearboxId id) {
            for (std::size_t i = 0; i < repeats; ++i, ++id.repeat) {
                const int first = record_window(plan, id, turns).first_mesh;
                all.push_back({first, first + meshes});
            }
        };
        add(record.id);
        if (record.id.record == Record::test) {
            continue;
        }
        GearboxId other = record.id;
        for (std::size_t k = 1; k < copies; ++k) {
            other.baseline = k;
            add(other);
        }
        if (compares) {
            other.record = Record::test;
            other.baseline = 0;
            add(other);
        }
    }
    std::ranges::sort(all, {}, &lockstep::SpanPart::first);
    std::vector<lockstep::SpanPart> parts;
    for (const lockstep::SpanPart& next : all) {
        if (!parts.empty() && next.first <= parts.back().end) {
            parts.back().end = std::max(parts.back().end, next.end);
        } else {
            parts.push_back(next);
        }
    }
    return parts;
}

RecordWindow record_window(const RecordPlan& plan, const GearboxId& id, int turns) {
    GearboxId shared = id;
    if (plan.same_window > 1) {
        shared.index -= id.index % plan.same_window;
        shared.exchanged = {};
        shared.noise_sampling = NoiseSampling::plain;
    }
    Philox engine = noise_stream(plan.seed, shared, StreamPurpose::record_start);
    boost::random::uniform_int_distribution<int> first(
        0, plan.signal_meshes - turns * plan.span.planet_teeth);
    return {turns, first(engine)};
}

}  // namespace gearpod::mc
