#include "mc/ensemble/coupling/record_positions.hpp"

#include <algorithm>
#include <boost/random/uniform_int_distribution.hpp>

#include "mc/plan/feature_needs.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/housing.hpp"
#include "mc/study/other_sources.hpp"

namespace gearpod::mc {

std::size_t computed_baselines(const Study& study) {
    const bool same =
        study.features.baseline_torque_scatter == 0.0 && !has_random_fluctuations(study) &&
        study.sensor.tones.empty() && !has_other_sources(study) &&
        std::ranges::none_of(
            study.random, [](const RandomInput& input) { return input.distribution.per_record(); });
    return same ? 1 : static_cast<std::size_t>(study.features.baseline_records);
}

bool share_positions(const GearboxId& a, const GearboxId& b, std::uint64_t together) {
    return a.group == b.group && a.record == b.record && a.baseline == b.baseline &&
           a.index / together == b.index / together;
}

int record_turns(const Scene& scene, const InstanceInputs& inputs) {
    const signals::SpanLayout& span = scene.span();
    const double mesh_Hz = 1.0 / dynamics::mesh_period_s(scene.inputs(inputs));
    return std::clamp(whole_turns(record_length(scene.study()), span, mesh_Hz), kLeastRecordTurns,
                      scene.signal_meshes() / span.planet_teeth);
}

bool shares_windows(const Study& study) {
    const bool random_speed = std::ranges::any_of(study.random, [](const RandomInput& input) {
        return input.quantity == RecordQuantity::speed;
    });
    return has_record_length(study) && !reason_not_periodic(study).empty() &&
           !study.effects.quasi_static() && !random_speed && !speed_fluctuates(study) &&
           study.ensemble.threshold_records == 1 && !study.life.interval_h && !is_coupled(study) &&
           !any_response(study);
}

bool shares_positions(const Study& study) {
    return is_coupled(study) || shares_windows(study);
}

std::size_t shared_records(const Study& study, std::span<const GearboxId> ids, std::size_t most) {
    most = std::min(most, ids.size());
    if (!shares_positions(study)) {
        return most;
    }
    const std::uint64_t together = is_coupled(study) ? kSharedPositions : kSharedWindows;
    std::size_t count = 1;
    while (count < most && share_positions(ids[count], ids[0], together)) {
        ++count;
    }
    return count;
}

std::vector<lockstep::SpanPart> parts_of_records(const Scene& scene,
                                                 std::span<const Realization> records) {
    const bool compares = !scene.features().needs.change.empty();
    // A motion that all baseline records have is cut at the window of each.
    const int copies =
        computed_baselines(scene.study()) == 1 ? scene.study().features.baseline_records : 1;
    std::vector<lockstep::SpanPart> all;
    for (const Realization& record : records) {
        const int turns = record_turns(scene, record.inputs);
        const int meshes = std::min(turns * scene.span().planet_teeth, scene.recorded_meshes());
        const auto add = [&](const GearboxId& id) {
            const int first = record_window(scene, id, turns).first_mesh;
            all.push_back({first, first + meshes});
        };
        add(record.id);
        if (record.id.record == Record::test) {
            continue;
        }
        GearboxId other = record.id;
        for (int k = 1; k < copies; ++k) {
            other.baseline = static_cast<std::size_t>(k);
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
    for (const lockstep::SpanPart& one : all) {
        if (!parts.empty() && one.first <= parts.back().end) {
            parts.back().end = std::max(parts.back().end, one.end);
        } else {
            parts.push_back(one);
        }
    }
    return parts;
}

RecordWindow record_window(const Scene& scene, const GearboxId& id, int turns) {
    GearboxId shared = id;
    if (shares_windows(scene.study())) {
        shared.index -= id.index % kSharedWindows;
        shared.exchanged = {};
        shared.noise_sampling = NoiseSampling::plain;
    }
    Philox engine = noise_stream(scene.draw().seed, shared, StreamPurpose::record_start);
    boost::random::uniform_int_distribution<int> first(
        0, scene.signal_meshes() - turns * scene.span().planet_teeth);
    return {turns, first(engine)};
}

}  // namespace gearpod::mc
