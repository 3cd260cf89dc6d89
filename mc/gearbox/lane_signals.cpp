// Extracts the signals of one gearbox of a tile, or of all of them.
#include "mc/gearbox/bearing_signals.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "mc/gearbox/tile_sensor_recorder.hpp"
#include "mc/scene/feature_needs.hpp"
#include "signals/sensor/sensor.hpp"

namespace gearpod::mc {

signals::TileSignals views_of(const Scene& scene, const GearboxTile& tile) {
    signals::TileSignals views{static_cast<int>(tile.realizations.size()),
                               dynamics::sources(scene.plan().layout),
                               scene.samples_per_mesh(),
                               {},
                               {}};
    for (const lockstep::MeshRecord& record : tile.integration.records) {
        views.accel.push_back(record.acceleration.data());
        views.te.push_back(record.te.data());
    }
    return views;
}

namespace {

// Folded signal of a sensor in one lane; empty for a quasi-static gearbox.
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
    lane_result.noise_m_s2 = tile.realizations[static_cast<std::size_t>(lane)].inputs.noise_m_s2;
    lane_result.folded = folded_of(tile, 0, lane);
    lane_result.te_turn.resize(tile.te_turn.size() / static_cast<std::size_t>(tile.views.lanes));
    signals::copy_lane(tile.te_turn, tile.views.lanes, lane, lane_result.te_turn);
    lane_result.additional.resize(path.additional.size());
    for (std::size_t s = 0; s < path.additional.size(); ++s) {
        lane_result.additional[s].folded = folded_of(tile, s + 1, lane);
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
    return has_record_length(scene.study()) && meshes == needed_sensor_meshes(scene);
}

// Transmission error of a lane over the mesh periods of the scene's signals.
std::vector<double> te_signal(const Scene& scene, const GearboxTile& tile, int lane) {
    const int meshes = scene.signal_meshes();
    if (!tile.sensor_responses.empty()) {
        return tile.sensor_responses.front()->te_signal(lane, meshes);
    }
    const auto& content = tile.integration.content;
    const auto lanes = static_cast<std::size_t>(tile.views.lanes);
    const auto samples = static_cast<std::size_t>(scene.te_samples_per_mesh());
    const std::size_t stride = static_cast<std::size_t>(scene.samples_per_mesh()) / samples * lanes;
    std::vector<double> te;
    for (std::size_t k = 0; k < static_cast<std::size_t>(meshes); ++k) {
        const double* mesh = tile.views.te[static_cast<std::size_t>(content[k % content.size()])];
        for (std::size_t p = 0; p < samples; ++p) {
            te.push_back(mesh[p * stride + static_cast<std::size_t>(lane)]);
        }
    }
    return te;
}

}  // namespace

namespace {

// The first sensor's signals for number 0, else those of an additional one.
LaneSignals& of_sensor(LaneSignals& signals, std::size_t sensor) {
    return sensor == 0 ? signals : signals.additional[sensor - 1];
}

// Adds what all lanes have in common to a lane with sensor samples.
void complete(const Scene& scene, const GearboxTile& tile, int lane, int meshes,
              LaneSignals& signals) {
    if (cuts_records(scene, meshes)) {
        signals.te = te_signal(scene, tile, lane);
    }
    const Realization& realization = tile.realizations[static_cast<std::size_t>(lane)];
    for (std::size_t sensor = 0; sensor <= signals.additional.size(); ++sensor) {
        add_bearings(scene, realization, BearingRole::background, of_sensor(signals, sensor));
    }
}

}  // namespace

LaneSignals lane_signals(const Scene& scene, const SensorPaths& path, const GearboxTile& tile,
                         int lane, int meshes) {
    LaneSignals lane_result = folded_lane(path, tile, lane);
    for (std::size_t sensor = 0; meshes > 0 && sensor <= path.additional.size(); ++sensor) {
        const signals::PathGrid& grid = sensor == 0 ? path.first : path.additional[sensor - 1];
        of_sensor(lane_result, sensor).sensor =
            !tile.sensor_responses.empty()
                ? tile.sensor_responses[sensor]->signal(lane, meshes)
                : signals::synthesize(
                      tile.views, lane, tile.integration.content, scene.span(), grid,
                      tile.realizations[static_cast<std::size_t>(lane)].inputs.path_exponent, 0,
                      meshes, tile.tones);
    }
    complete(scene, tile, lane, meshes, lane_result);
    return lane_result;
}

std::vector<LaneSignals> all_lane_signals(const Scene& scene, const SensorPaths& path,
                                          const GearboxTile& tile, int meshes) {
    std::vector<LaneSignals> all;
    for (std::size_t lane = 0; lane < tile.status.size(); ++lane) {
        all.push_back(folded_lane(path, tile, static_cast<int>(lane)));
    }
    for (std::size_t sensor = 0; meshes > 0 && sensor <= path.additional.size(); ++sensor) {
        const signals::PathGrid& grid = sensor == 0 ? path.first : path.additional[sensor - 1];
        auto samples = !tile.sensor_responses.empty()
                           ? tile.sensor_responses[sensor]->signals(all.size(), meshes)
                           : signals::synthesize(
                                 tile.views, tile.integration.content, scene.span(), grid,
                                 path_exponents(std::span(tile.realizations).first(all.size())), 0,
                                 meshes, tile.tones);
        for (std::size_t lane = 0; lane < all.size(); ++lane) {
            of_sensor(all[lane], sensor).sensor = std::move(samples[lane]);
        }
    }
    for (std::size_t lane = 0; lane < all.size(); ++lane) {
        complete(scene, tile, static_cast<int>(lane), meshes, all[lane]);
    }
    return all;
}

SensorSignals signals_of_sensor(const LaneSignals& all, std::size_t sensor, double noise) {
    const auto one = [&](const LaneSignals& record) {
        LaneSignals own = record.additional[sensor];
        own.te_turn = record.te_turn;
        own.te = record.te;
        own.noise_m_s2 = noise * record.noise_m_s2;
        return own;
    };
    SensorSignals own{one(all), {}};
    for (std::size_t k = 0; k < all.baselines; ++k) {
        own.baseline.push_back(one(all.baseline[k]));
    }
    return own;
}

}  // namespace gearpod::mc
