// Signals of the gearboxes of a tile: evaluates the stages of each sensor up to the noise. Without
// samples, the squares that were folded with the tile take the place of the stages.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>

#include "machine/team.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/tile_sensors.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {

signals::TileSignals views_of(const RecordPlan& record, const GearboxTile& tile) {
    signals::TileSignals views{
        static_cast<int>(tile.realizations.size()), record.planet_sources, record.samples, {}, {}};
    views.further_sources = record.sources - record.planet_sources;
    for (const lockstep::MeshRecord& mesh : tile.integration.records) {
        views.accel.push_back(mesh.acceleration.data());
        views.te.push_back(mesh.te.data());
    }
    return views;
}

std::vector<double> recorded_te(const RecordPlan& plan, const GearboxTile& tile, LaneId lane,
                                int first, int meshes, int samples) {
    const auto& content = tile.integration.content;
    const int stride = plan.samples / samples * tile.views.lanes;
    std::vector<double> te;
    for (int k = first; k < first + meshes; ++k) {
        const int record = content[static_cast<std::size_t>(k) % content.size()];
        const double* mesh = tile.views.te[static_cast<std::size_t>(record)];
        for (int p = 0; p < samples; ++p) {
            te.push_back(mesh[p * stride + lane]);
        }
    }
    return te;
}

void remove_mean(std::vector<double>& values) {
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (double& value : values) {
        value -= mean;
    }
}

namespace {

// Folded signal of a sensor in one lane; empty as in the tile.
std::vector<double> folded_of(const GearboxTile& tile, SensorId sensor, LaneId lane) {
    if (!(sensor < tile.folded.size())) {
        return {};
    }
    const machine::AlignedVector& all = tile.folded[sensor];
    std::vector<double> folded(all.size() / static_cast<std::size_t>(tile.views.lanes));
    signals::copy_lane(all, tile.views.lanes, lane, folded);
    return folded;
}

// All signals of a lane except the sensor samples.
LaneSignals folded_lane(std::size_t sensors, const GearboxTile& tile, LaneId lane) {
    LaneSignals signals;
    signals.noise = noise_of(tile.realizations[lane].inputs);
    signals.folded = folded_of(tile, SensorId{0}, lane);
    signals.te_turn.resize(tile.te_turn.size() / static_cast<std::size_t>(tile.views.lanes));
    signals::copy_lane(tile.te_turn, tile.views.lanes, lane, signals.te_turn);
    signals.additional.resize(sensors - 1);
    for (SensorId s{1}; s < sensors; ++s) {
        signals.additional[s - 1].folded = folded_of(tile, s, lane);
    }
    if (!tile.baseline.empty()) {
        signals.baselines = tile.baseline.size() / tile.status.size();
        signals.baseline = &tile.baseline[lane * signals.baselines];
    }
    for (const auto& stage : tile.coupled) {
        signals.coupled.push_back(stage[lane]);
    }
    return signals;
}

// Transmission error of a lane over the mesh periods of the signals.
std::vector<double> te_signal(const RecordPlan& plan, const GearboxTile& tile, LaneId lane) {
    if (!tile.sensor_recorders.empty()) {
        return tile.sensor_recorders.front().front()->te_signal(lane, plan.signal_meshes);
    }
    return recorded_te(plan, tile, lane, 0, plan.signal_meshes, plan.te_samples);
}

// Samples of lanes of a tile at all sensors.
class LaneSamples {
  public:
    // `other`: vibration of other sources in each lane; may be empty.
    LaneSamples(const RecordPlan& plan, const GearboxTile& tile, std::size_t first_lane, int meshes,
                std::vector<std::vector<double>> other, std::span<LaneSignals> lanes)
        : plan_(plan),
          tile_(tile),
          first_lane_(first_lane),
          meshes_(meshes),
          other_(std::move(other)),
          lanes_(lanes) {}

    // Evaluates the stages of a sensor up to the noise.
    void evaluate(const SensorPlan& sensor) {
        sensor_ = &sensor;
        changed_ = false;
        for (const SensorStage& stage : sensor.stages) {
            std::visit([&](const auto& each) { apply(each); }, stage);
        }
        for (std::size_t i = 0; changed_ && i < lanes_.size(); ++i) {
            fold_again(plan_, of_lane(i));
        }
    }

  private:
    LaneSignals& of_lane(std::size_t i) {
        return sensor_->number == 0 ? lanes_[i] : lanes_[i].additional[sensor_->number - 1];
    }
    LaneId tile_lane(std::size_t i) const { return LaneId{first_lane_ + i}; }
    const InstanceInputs& inputs(std::size_t i) const {
        return tile_.realizations[first_lane_ + i].inputs;
    }

    std::vector<double> along(std::size_t path, std::size_t i, int meshes,
                              const signals::Tones& tones = {}) const {
        if (!tile_.sensor_recorders.empty()) {
            return tile_.sensor_recorders[sensor_->number][path]->signal(tile_lane(i), meshes);
        }
        const std::span<const Realization> gearbox(&tile_.realizations[first_lane_ + i], 1);
        return signals::synthesize(tile_.views, tile_lane(i), tile_.integration.content, plan_.span,
                                   sensor_->paths[path], path_exponents(gearbox, path).front(), 0,
                                   meshes, tones);
    }

    void apply(const PathStage&) {
        if (lanes_.size() == 1) {
            of_lane(0).sensor = along(0, 0, meshes_, tile_.tones);
            return;
        }
        auto samples =
            !tile_.sensor_recorders.empty()
                ? tile_.sensor_recorders[sensor_->number].front()->signals(lanes_.size(), meshes_)
                : signals::synthesize(
                      tile_.views, tile_.integration.content, plan_.span, sensor_->paths.front(),
                      path_exponents(std::span(tile_.realizations).first(lanes_.size()), 0), 0,
                      meshes_, tile_.tones);
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            of_lane(i).sensor = std::move(samples[i]);
        }
    }

    // The response is computed over all samples of the signal, of which the first mesh periods are
    // kept.
    void apply(const ResponseStage& stage) {
        if (!response_) {
            response_.emplace(plan_.signal_meshes * plan_.samples);
        }
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            const double sampling_Hz = 1.0 / plan_.sample_s(inputs(i));
            for (const PathResponse& part : stage.parts) {
                machine::throw_if_cancelled();
                std::vector<double> load = along(part.first_path, i, plan_.signal_meshes);
                for (std::size_t path = 1; path < part.paths; ++path) {
                    machine::throw_if_cancelled();
                    const auto next = along(part.first_path + path, i, plan_.signal_meshes);
                    std::ranges::transform(load, next, load.begin(), std::plus<>());
                }
                response_->add(load, sampling_Hz, part.of(inputs(i)));
            }
            std::vector<double>& samples = of_lane(i).sensor;
            samples = response_->take(stage.chain, sampling_Hz);
            samples.resize(static_cast<std::size_t>(meshes_) *
                           static_cast<std::size_t>(plan_.samples));
        }
        changed_ = true;
    }

    void apply(const TonesStage& stage) {
        const signals::Tones tones = passed_tones(stage.chain);
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            signals::add_tones(tones, tile_lane(i), plan_.samples, of_lane(i).sensor);
        }
    }

    void apply(const OtherSourcesStage& stage) {
        for (std::size_t i = 0; i < other_.size(); ++i) {
            std::vector<double>& samples = of_lane(i).sensor;
            const auto added = stage.chain ? passed(*stage.chain, i) : other_[i];
            std::ranges::transform(samples, added, samples.begin(), std::plus<>());
            changed_ = true;
        }
    }

    // Stages of records (RealizationSignals).
    void apply(const NoiseStage&) const {}
    void apply(const RangeStage&) const {}

    // Tones of the tile after a measuring chain. Those above half its sampling rate have the
    // frequency to which it folds them, of either sign.
    signals::Tones passed_tones(const std::optional<signals::MeasuringChain>& chain) const {
        signals::Tones tones = tile_.tones;
        const auto samples =
            static_cast<std::size_t>(plan_.signal_meshes) * static_cast<std::size_t>(plan_.samples);
        for (std::size_t i = 0; chain && i < tones.frequency_Hz.size(); ++i) {
            const std::complex<double> factor = chain->at(tones.frequency_Hz[i]);
            tones.amplitude_m_s2[i] *= std::abs(factor);
            tones.phase_rad[i] += std::arg(factor);
            const double mesh_s = tones.mesh_period_s[i % tones.mesh_period_s.size()];
            const std::size_t taken = chain->own_samples(samples, plan_.samples / mesh_s);
            if (taken < samples) {
                const double rate_Hz = static_cast<double>(taken) / (plan_.signal_meshes * mesh_s);
                tones.frequency_Hz[i] = std::remainder(tones.frequency_Hz[i], rate_Hz);
            }
        }
        return tones;
    }

    // Vibration of other sources in a lane after a measuring chain.
    std::vector<double> passed(const signals::MeasuringChain& chain, std::size_t i) {
        const double sampling_Hz = 1.0 / plan_.sample_s(inputs(i));
        if (!other_response_) {
            other_response_.emplace(static_cast<int>(other_[i].size()));
        }
        other_response_->add(other_[i], sampling_Hz, {.modes = {}, .measured = {}, .chain = chain});
        return other_response_->take(chain, sampling_Hz);
    }

    const RecordPlan& plan_;
    const GearboxTile& tile_;
    const std::size_t first_lane_;
    const int meshes_;
    const std::vector<std::vector<double>> other_;
    const std::span<LaneSignals> lanes_;
    const SensorPlan* sensor_ = nullptr;
    bool changed_ = false;  // true if the samples are no longer those that the tile has folded
    // Made where they are needed first.
    std::optional<signals::PeriodicResponse> response_, other_response_;
};

std::vector<LaneSignals> signals_of_lanes(const TilePlan& plan, const GearboxTile& tile,
                                          std::size_t first, std::size_t count, int meshes) {
    const RecordPlan& record = plan.record;
    const std::vector<SensorPlan>& sensors = *plan.sensors;
    std::vector<LaneSignals> lanes;
    for (LaneId lane{first}; lane < first + count; ++lane) {
        lanes.push_back(folded_lane(sensors.size(), tile, lane));
    }
    // Records that are cut from the signals need their transmission error, too.
    if (record.length && meshes == record.sensor_meshes(plan.features.needs.all())) {
        for (std::size_t i = 0; i < count; ++i) {
            lanes[i].te = te_signal(record, tile, LaneId{first + i});
        }
    }
    if (meshes > 0) {
        const auto realizations = std::span(tile.realizations).subspan(first, count);
        LaneSamples samples(record, tile, first, meshes,
                            background_vibration(plan, realizations, lanes, meshes), lanes);
        for (const SensorPlan& sensor : sensors) {
            samples.evaluate(sensor);
        }
    }
    return lanes;
}

}  // namespace

LaneSignals lane_signals(const TilePlan& plan, const GearboxTile& tile, LaneId lane, int meshes) {
    return std::move(signals_of_lanes(plan, tile, lane, 1, meshes).front());
}

std::vector<LaneSignals> all_lane_signals(const TilePlan& plan, const GearboxTile& tile,
                                          int meshes) {
    return signals_of_lanes(plan, tile, 0, tile.status.size(), meshes);
}

SensorSignals signals_of_sensor(const SensorPlan& sensor, const LaneSignals& all) {
    const auto at_sensor = [&](const LaneSignals& record) {
        LaneSignals signals = record.additional[sensor.number - 1];
        signals.te_turn = record.te_turn;
        signals.te = record.te;
        signals.noise = sensor.noise().of(record.noise);
        return signals;
    };
    SensorSignals signals{at_sensor(all), {}};
    for (std::size_t k = 0; k < all.baselines; ++k) {
        signals.baseline.push_back(at_sensor(all.baseline[k]));
    }
    return signals;
}

}  // namespace gearpod::mc
