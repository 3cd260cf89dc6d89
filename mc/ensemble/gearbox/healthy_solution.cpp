#include "mc/ensemble/gearbox/healthy_solution.hpp"

#include <algorithm>
#include <cmath>

#include "mc/ensemble/gearbox/tile_sensors.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {

namespace {

// Mesh periods of the span that were integrated again, and the record of each of them.
struct ChangedMeshes {
    std::vector<int> meshes;
    signals::Timeline timeline;  // unchanged mesh periods refer to an arbitrary record

    explicit ChangedMeshes(const lockstep::TileResult& integration)
        : timeline(integration.content) {
        for (std::size_t k = 0; k < timeline.size(); ++k) {
            if (timeline[k] == lockstep::kUnchanged) {
                timeline[k] = 0;
            } else {
                meshes.push_back(static_cast<int>(k));
            }
        }
    }
};

// True if mesh period k differs from the healthy one in a lane (lockstep::TileResult).
bool changes(const lockstep::TileResult& integration, int k, LaneId lane) {
    const int record = integration.content[static_cast<std::size_t>(k)];
    return record != lockstep::kUnchanged &&
           !std::isnan(integration.records[static_cast<std::size_t>(record)].te[lane]);
}

void clear_failed(HealthySolution::Signals& all) {
    for (LaneId lane{0}; lane < all.status.size(); ++lane) {
        if (all.status[lane] != Status::ok) {
            all.lane[lane] = {};
        }
    }
}

}  // namespace

HealthySolution::HealthySolution(const TilePlan& plan, std::vector<Realization> realizations,
                                 int fewest)
    : plan_(plan), realizations_(std::move(realizations)) {
    for (Realization& one : realizations_) {
        one.inputs.gain = 1.0;
    }
    const bool keep = plan.solve->perturbation_only;
    TileOptions options;
    if (keep) {
        options.records.emplace().states = true;
    }
    GearboxTile tile = run_realizations(plan, with_size(0.0), fewest, options);
    healthy_ = signals_of(tile);
    lanes_ = static_cast<int>(tile.realizations.size());
    if (keep) {
        states_ = std::move(tile.integration.states);
        for (const int record : tile.integration.content) {
            te_.push_back(std::move(tile.integration.records[static_cast<std::size_t>(record)].te));
        }
    }
}

std::vector<Realization> HealthySolution::with_size(double size) const {
    std::vector<Realization> all = realizations_;
    for (Realization& one : all) {
        one.inputs.fault_size = size;
    }
    return all;
}

HealthySolution::Signals HealthySolution::signals_of(const GearboxTile& tile) const {
    Signals all{all_lane_signals(plan_, tile, plan_.record.span.meshes()), tile.status};
    clear_failed(all);
    return all;
}

HealthySolution::Signals HealthySolution::with_fault(double size) const {
    if (states_.all.empty()) {
        return signals_of(run_realizations(plan_, with_size(size), lanes_));
    }
    const GearboxTile changed = run_fault_perturbations(plan_, with_size(size), lanes_, states_);
    Signals all = healthy_;
    for (LaneId lane{0}; lane < realizations_.size(); ++lane) {
        all.lane[lane].folded.clear();  // the folded squares of the healthy gearbox no longer apply
        if (all.status[lane] == Status::ok) {
            all.status[lane] = changed.status[lane];
        }
    }
    change_te(changed, all.lane);
    change_sensor(changed, all.lane);
    clear_failed(all);
    return all;
}

// Adds to the average of tooth j the mean change of its mesh periods (signals::average_te).
void HealthySolution::change_te(const GearboxTile& changed, std::vector<LaneSignals>& lanes) const {
    const auto per_mesh = static_cast<std::size_t>(plan_.record.te_samples);
    const std::size_t width = static_cast<std::size_t>(lanes_),
                      stride = static_cast<std::size_t>(plan_.record.samples) / per_mesh * width;
    const auto teeth = static_cast<std::size_t>(plan_.record.span.planet_teeth);
    const double share = 1.0 / plan_.record.span.ring_teeth;
    for (std::size_t k = 0; k < changed.integration.content.size(); ++k) {
        const int record = changed.integration.content[k];
        if (record == lockstep::kUnchanged) {
            continue;
        }
        const auto& now = changed.integration.records[static_cast<std::size_t>(record)].te;
        for (LaneId lane{0}; lane < realizations_.size(); ++lane) {
            std::vector<double>& turn = lanes[lane].te_turn;
            if (turn.empty() || !changes(changed.integration, static_cast<int>(k), lane)) {
                continue;
            }
            for (std::size_t p = 0; p < per_mesh; ++p) {
                const std::size_t at = p * stride + lane;
                turn[k % teeth * per_mesh + p] += share * (now[at] - te_[k][at]);
            }
        }
    }
    for (LaneSignals& lane : lanes) {
        remove_mean(lane.te_turn);
    }
}

void HealthySolution::change_sensor(const GearboxTile& changed,
                                    std::vector<LaneSignals>& lanes) const {
    const ChangedMeshes span(changed.integration);
    if (span.meshes.empty()) {
        return;
    }
    const int phases = plan_.record.samples;
    const auto sensor = signals::synthesize(views_of(plan_.record, changed), span.timeline,
                                            plan_.record.span, plan_.sensors->front().paths.front(),
                                            path_exponents(realizations_, 0), span.meshes);
    for (LaneId lane{0}; lane < realizations_.size(); ++lane) {
        if (lanes[lane].sensor.empty()) {
            continue;
        }
        for (std::size_t i = 0; i < span.meshes.size(); ++i) {
            const int k = span.meshes[i];
            if (changes(changed.integration, k, lane)) {
                std::copy_n(sensor[lane].begin() + static_cast<std::ptrdiff_t>(i) * phases, phases,
                            lanes[lane].sensor.begin() + static_cast<std::ptrdiff_t>(k) * phases);
            }
        }
    }
}

}  // namespace gearpod::mc
