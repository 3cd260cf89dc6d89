// Measures the time for computing records, for forecasts.
#include <algorithm>

#include "machine/thread_clock.hpp"
#include "mc/lives/life_lane.hpp"

namespace gearpod::mc {

LaneSignals LifeTiles::synthetic_signals(std::uint64_t number) const {
    const auto samples = [&](int of_mesh, int meshes) {
        return static_cast<std::size_t>(of_mesh) * static_cast<std::size_t>(meshes);
    };
    LaneSignals all;
    Philox engine =
        gearbox_stream(scene_.study(), {Group::graded, number}, StreamPurpose::forecast_signals);
    all.sensor.resize(samples(scene_.samples_per_mesh(), scene_.span_meshes()));
    signals::draw_normals(engine, std::span(all.sensor));
    all.te_turn.resize(samples(scene_.te_samples_per_mesh(), scene_.span().planet_teeth));
    signals::draw_normals(engine, std::span(all.te_turn));
    return all;
}

RecordTimes LifeTiles::time_records() const {
    const std::vector<LaneSignals> none, healthy(load_count(), synthetic_signals(0)),
        low(load_count(), synthetic_signals(1)), high(load_count(), synthetic_signals(2));
    Lane lane(*this, draw({Group::graded, 0}), false);
    lane.compute_reference_pattern(healthy);
    const auto seconds = [](const auto& work) {
        const double start = thread_processor_s();
        work();
        return thread_processor_s() - start;
    };
    const double first_s = seconds([&] { lane.superpose(lane.basis_of(healthy, none, high)); });
    const double step_s = seconds([&] { lane.superpose(lane.basis_of(healthy, low, high)); });
    const double all_s = seconds([&] { lane.compute_records(0.0, depth(1), healthy, none, high); });
    return {step_s, std::max(0.0, all_s - first_s) / scene_.study().life.records};
}

LifeHistory LifeTiles::history(const GearboxId& id) const {
    return crack_.history(draw(id), true);
}

}  // namespace gearpod::mc
