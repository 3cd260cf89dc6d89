#include "mc/ensemble/gearbox/record_window.hpp"

#include <algorithm>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {
namespace {

std::vector<double> part(const std::vector<double>& samples, std::size_t first, std::size_t count) {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

std::span<const double> folded_part(const RecordPlan& plan, const LaneSignals& record,
                                    std::span<const double> samples) {
    const int turns = record.turns > 0 ? record.turns : plan.span.ring_teeth;
    return samples.first(static_cast<std::size_t>(turns) * plan.turn_samples());
}

std::vector<double> folded_squares(const RecordPlan& plan, const LaneSignals& record,
                                   std::span<const double> samples) {
    return signals::fold_of_squares(folded_part(plan, record, samples), plan.turn_samples());
}

void fold_again(const RecordPlan& plan, LaneSignals& record) {
    record.folded = folded_squares(plan, record, record.sensor);
}

LaneSignals cut_record(const RecordPlan& plan, const LaneSignals& signals,
                       const RecordWindow& window, bool samples) {
    const auto teeth = static_cast<std::size_t>(plan.span.planet_teeth);
    const auto first = static_cast<std::size_t>(window.first_mesh),
               meshes = static_cast<std::size_t>(window.turns) * teeth;
    LaneSignals record;
    record.noise = signals.noise;
    record.turns = window.turns;
    record.first_mesh = window.first_mesh;
    if (!signals.sensor.empty()) {
        const auto phases = static_cast<std::size_t>(plan.samples);
        record.sensor = part(signals.sensor, first * phases, meshes * phases);
        fold_again(plan, record);
    }
    if (!samples) {
        record.sensor.clear();
    }
    const auto phases = static_cast<std::size_t>(plan.te_samples);
    const std::vector<double> te = part(signals.te, first * phases, meshes * phases);
    record.te_turn = signals::synchronous_average(te, teeth * phases);
    remove_mean(record.te_turn);
    return record;
}

LaneSignals drawn_record(const RecordPlan& plan, LaneSignals signals,
                         const Realization& realization) {
    if (!plan.length) {
        return signals;
    }
    const int turns = plan.turns(realization.inputs);
    return cut_record(plan, signals, record_window(plan, realization.id, turns), true);
}

void rotate_to_first_tooth(const LaneSignals& record, int per_mesh, std::vector<double>& turn) {
    if (turn.empty()) {
        return;
    }
    const std::size_t first = static_cast<std::size_t>(record.first_mesh) *
                              static_cast<std::size_t>(per_mesh) % turn.size();
    std::ranges::rotate(turn, turn.end() - static_cast<std::ptrdiff_t>(first));
}

}  // namespace gearpod::mc
