// Extracts the signals of one gearbox of a tile, or of all of them.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>

#include "machine/team.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/gearbox/tile_sensors.hpp"
#include "mc/study/housing.hpp"
#include "signals/sensor/sensor_signal.hpp"

namespace gearpod::mc {

signals::TileSignals views_of(const Scene& scene, const GearboxTile& tile) {
    signals::TileSignals views{static_cast<int>(tile.realizations.size()),
                               dynamics::sources(scene.plan().layout),
                               scene.samples_per_mesh(),
                               {},
                               {}};
    if (!housing_bearings(scene.study()).empty()) {
        views.planets -= dynamics::kBearingSources;
        views.further_sources = dynamics::kBearingSources;
    }
    for (const lockstep::MeshRecord& record : tile.integration.records) {
        views.accel.push_back(record.acceleration.data());
        views.te.push_back(record.te.data());
    }
    return views;
}

std::vector<double> recorded_te(const Scene& scene, const GearboxTile& tile, int lane, int first,
                                int meshes, int samples) {
    const auto& content = tile.integration.content;
    const int stride = scene.samples_per_mesh() / samples * tile.views.lanes;
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
std::vector<double> folded_of(const GearboxTile& tile, std::size_t sensor, int lane) {
    if (sensor >= tile.folded.size()) {
        return {};
    }
    const machine::AlignedVector& all = tile.folded[sensor];
    std::vector<double> folded(all.size() / static_cast<std::size_t>(tile.views.lanes));
    signals::copy_lane(all, tile.views.lanes, lane, folded);
    return folded;
}

// All signals of a lane except the sensor samples.
LaneSignals folded_lane(const SensorPaths& path, const GearboxTile& tile, int lane) {
    LaneSignals lane_result;
    lane_result.noise = noise_of(tile.realizations[static_cast<std::size_t>(lane)].inputs);
    lane_result.folded = folded_of(tile, 0, lane);
    lane_result.te_turn.resize(tile.te_turn.size() / static_cast<std::size_t>(tile.views.lanes));
    signals::copy_lane(tile.te_turn, tile.views.lanes, lane, lane_result.te_turn);
    lane_result.additional.resize(path.size() - 1);
    for (std::size_t s = 1; s < path.size(); ++s) {
        lane_result.additional[s - 1].folded = folded_of(tile, s, lane);
    }
    if (!tile.baseline.empty()) {
        lane_result.baselines = tile.baseline.size() / tile.status.size();
        lane_result.baseline =
            &tile.baseline[static_cast<std::size_t>(lane) * lane_result.baselines];
    }
    return lane_result;
}

// True if records are cut from these signals, which then include the transmission error.
bool cuts_records(const Scene& scene, int meshes) {
    return scene.record().length && meshes == needed_sensor_meshes(scene);
}

// Transmission error of a lane over the mesh periods of the scene's signals.
std::vector<double> te_signal(const Scene& scene, const GearboxTile& tile, int lane) {
    const int meshes = scene.signal_meshes();
    if (!tile.sensor_recorders.empty()) {
        return tile.sensor_recorders.front().front()->te_signal(lane, meshes);
    }
    return recorded_te(scene, tile, lane, 0, meshes, scene.te_samples_per_mesh());
}

// The first sensor's signals for number 0, else those of an additional one.
LaneSignals& of_sensor(LaneSignals& signals, std::size_t sensor) {
    return sensor == 0 ? signals : signals.additional[sensor - 1];
}

// Samples of a lane along one path of a sensor.
std::vector<double> samples_along(const Scene& scene, const SensorPaths& path,
                                  const GearboxTile& tile, std::size_t sensor, std::size_t part,
                                  int lane, int meshes) {
    if (!tile.sensor_recorders.empty()) {
        return tile.sensor_recorders[sensor][part]->signal(lane, meshes);
    }
    const std::span<const Realization> own(&tile.realizations[static_cast<std::size_t>(lane)], 1);
    return signals::synthesize(tile.views, lane, tile.integration.content, scene.span(),
                               path[sensor][part], path_exponents(own, part).front(), 0, meshes,
                               has_response(scene.study(), sensor) ? signals::Tones{} : tile.tones);
}

// Tones of a tile as a sensor measures them: they pass its measuring chain, but not the housing.
// Those above half its sampling rate have the frequency to which it folds them, of either sign.
signals::Tones tones_at(const Scene& scene, std::size_t sensor, const signals::Tones& tones) {
    signals::Tones own = tones;
    const auto chain = measuring_chain(scene.study(), sensor);
    const auto samples = static_cast<std::size_t>(scene.signal_meshes()) *
                         static_cast<std::size_t>(scene.samples_per_mesh());
    for (std::size_t i = 0; chain && i < own.frequency_Hz.size(); ++i) {
        const std::complex<double> factor = chain->at(own.frequency_Hz[i]);
        own.amplitude_m_s2[i] *= std::abs(factor);
        own.phase_rad[i] += std::arg(factor);
        const double mesh_s = own.mesh_period_s[i % own.mesh_period_s.size()];
        const std::size_t taken = chain->own_samples(samples, scene.samples_per_mesh() / mesh_s);
        if (taken < samples) {
            const double rate_Hz = static_cast<double>(taken) / (scene.signal_meshes() * mesh_s);
            own.frequency_Hz[i] = std::remainder(own.frequency_Hz[i], rate_Hz);
        }
    }
    return own;
}

// Adds the response of a sensor and the tones to a lane. The response is computed over all samples
// of the scene, of which the first `meshes` mesh periods are kept.
void add_response(const Scene& scene, const SensorPaths& path, const GearboxTile& tile,
                  std::size_t sensor, int lane, int meshes,
                  std::optional<signals::PeriodicResponse>& response, LaneSignals& own) {
    const Study& study = scene.study();
    const InstanceInputs& inputs = tile.realizations[static_cast<std::size_t>(lane)].inputs;
    const double factor = inputs.housing_frequency_factor,
                 sampling_Hz = 1.0 / scene.record().sample_s(inputs);
    const auto along = [&](std::size_t part) {
        machine::throw_if_cancelled();
        return samples_along(scene, path, tile, sensor, part, lane, scene.signal_meshes());
    };
    if (!response) {
        response.emplace(scene.signal_meshes() * scene.samples_per_mesh());
    }
    response->add(along(0), sampling_Hz, housing_response(study, sensor, factor));
    const std::vector<int> ring = ring_modes(study);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        std::vector<double> load = along(1 + 2 * i);
        const std::vector<double> along_y = along(2 + 2 * i);
        std::ranges::transform(load, along_y, load.begin(), std::plus<>());
        response->add(load, sampling_Hz, ring_response(study, sensor, ring[i], factor));
    }
    const std::vector<HousingBearing> bearings = housing_bearings(study);
    for (std::size_t i = 0; i < bearings.size(); ++i) {
        const BodyInstance& body = inputs.bodies[bearings[i].shaft];
        response->add(
            along(1 + 2 * ring.size() + i), sampling_Hz,
            bearing_response(study, sensor, bearings[i],
                             {body.bearing_stiffness_N_m, body.bearing_damping_N_s_m}, factor));
    }
    const auto chain = measuring_chain(study, sensor);
    own.sensor = response->take(chain, sampling_Hz);
    own.sensor.resize(static_cast<std::size_t>(meshes) *
                      static_cast<std::size_t>(scene.samples_per_mesh()));
    if (!tile.tones.empty()) {
        signals::add_tones(tones_at(scene, sensor, tile.tones), lane, scene.samples_per_mesh(),
                           own.sensor);
    }
    fold_again(scene.record(), own);
}

// Adds the transmission error to lanes with sensor samples, `first` the first of them, and other
// sources of vibration.
void complete(const Scene& scene, const GearboxTile& tile, std::size_t first, int meshes,
              std::span<LaneSignals> lanes) {
    for (std::size_t i = 0; i < lanes.size() && cuts_records(scene, meshes); ++i) {
        lanes[i].te = te_signal(scene, tile, static_cast<int>(first + i));
    }
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        for (const auto& stage : tile.coupled) {
            lanes[i].coupled.push_back(stage[first + i]);
        }
    }
    add_background(scene, std::span(tile.realizations).subspan(first, lanes.size()), lanes);
}

}  // namespace

LaneSignals lane_signals(const Scene& scene, const SensorPaths& path, const GearboxTile& tile,
                         int lane, int meshes) {
    LaneSignals lane_result = folded_lane(path, tile, lane);
    std::optional<signals::PeriodicResponse> response;
    for (std::size_t sensor = 0; meshes > 0 && sensor < path.size(); ++sensor) {
        LaneSignals& own = of_sensor(lane_result, sensor);
        if (has_response(scene.study(), sensor)) {
            add_response(scene, path, tile, sensor, lane, meshes, response, own);
        } else {
            own.sensor = samples_along(scene, path, tile, sensor, 0, lane, meshes);
        }
    }
    complete(scene, tile, static_cast<std::size_t>(lane), meshes, std::span(&lane_result, 1));
    return lane_result;
}

std::vector<LaneSignals> all_lane_signals(const Scene& scene, const SensorPaths& path,
                                          const GearboxTile& tile, int meshes) {
    std::vector<LaneSignals> all;
    for (std::size_t lane = 0; lane < tile.status.size(); ++lane) {
        all.push_back(folded_lane(path, tile, static_cast<int>(lane)));
    }
    std::optional<signals::PeriodicResponse> response;
    for (std::size_t sensor = 0; meshes > 0 && sensor < path.size(); ++sensor) {
        if (has_response(scene.study(), sensor)) {
            for (std::size_t lane = 0; lane < all.size(); ++lane) {
                add_response(scene, path, tile, sensor, static_cast<int>(lane), meshes, response,
                             of_sensor(all[lane], sensor));
            }
            continue;
        }
        auto samples =
            !tile.sensor_recorders.empty()
                ? tile.sensor_recorders[sensor].front()->signals(all.size(), meshes)
                : signals::synthesize(
                      tile.views, tile.integration.content, scene.span(), path[sensor].front(),
                      path_exponents(std::span(tile.realizations).first(all.size()), 0), 0, meshes,
                      tile.tones);
        for (std::size_t lane = 0; lane < all.size(); ++lane) {
            of_sensor(all[lane], sensor).sensor = std::move(samples[lane]);
        }
    }
    complete(scene, tile, 0, meshes, all);
    return all;
}

SensorSignals signals_of_sensor(const Study& study, const LaneSignals& all, std::size_t sensor) {
    const auto one = [&](const LaneSignals& record) {
        LaneSignals own = record.additional[sensor];
        own.te_turn = record.te_turn;
        own.te = record.te;
        own.noise = noise_at(study, study.sensor.additional[sensor], record.noise);
        return own;
    };
    SensorSignals own{one(all), {}};
    for (std::size_t k = 0; k < all.baselines; ++k) {
        own.baseline.push_back(one(all.baseline[k]));
    }
    return own;
}

}  // namespace gearpod::mc
