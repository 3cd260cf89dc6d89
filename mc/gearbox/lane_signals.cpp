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

// All signals of a lane except the sensor samples.
LaneSignals folded_lane(const GearboxTile& tile, int lane) {
    const auto lanes = static_cast<std::size_t>(tile.views.lanes);
    LaneSignals lane_result;
    lane_result.noise_m_s2 = tile.realizations[static_cast<std::size_t>(lane)].inputs.noise_m_s2;
    lane_result.folded.resize(tile.folded.size() / lanes);
    lane_result.te_turn.resize(tile.te_turn.size() / lanes);
    signals::copy_lane(tile.folded, tile.views.lanes, lane, lane_result.folded);
    signals::copy_lane(tile.te_turn, tile.views.lanes, lane, lane_result.te_turn);
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
    if (tile.sensor_response != nullptr) {
        return tile.sensor_response->te_signal(lane, meshes);
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

LaneSignals lane_signals(const Scene& scene, const signals::PathGrid& path, const GearboxTile& tile,
                         int lane, int meshes) {
    LaneSignals lane_result = folded_lane(tile, lane);
    if (meshes > 0 && tile.sensor_response != nullptr) {
        lane_result.sensor = tile.sensor_response->signal(lane, meshes);
    } else if (meshes > 0) {
        lane_result.sensor = signals::synthesize(
            tile.views, lane, tile.integration.content, scene.span(), path,
            tile.realizations[static_cast<std::size_t>(lane)].inputs.path_exponent, 0, meshes,
            tile.tones);
    }
    if (cuts_records(scene, meshes)) {
        lane_result.te = te_signal(scene, tile, lane);
    }
    add_bearings(scene, tile.realizations[static_cast<std::size_t>(lane)], BearingRole::background,
                 lane_result);
    return lane_result;
}

std::vector<LaneSignals> all_lane_signals(const Scene& scene, const signals::PathGrid& path,
                                          const GearboxTile& tile, int meshes) {
    std::vector<LaneSignals> all;
    for (std::size_t lane = 0; lane < tile.status.size(); ++lane) {
        all.push_back(folded_lane(tile, static_cast<int>(lane)));
        if (cuts_records(scene, meshes)) {
            all.back().te = te_signal(scene, tile, static_cast<int>(lane));
        }
    }
    if (meshes > 0) {
        auto sensor = tile.sensor_response != nullptr
                          ? tile.sensor_response->signals(all.size(), meshes)
                          : signals::synthesize(
                                tile.views, tile.integration.content, scene.span(), path,
                                path_exponents(std::span(tile.realizations).first(all.size())), 0,
                                meshes, tile.tones);
        for (std::size_t lane = 0; lane < all.size(); ++lane) {
            all[lane].sensor = std::move(sensor[lane]);
            add_bearings(scene, tile.realizations[lane], BearingRole::background, all[lane]);
        }
    }
    return all;
}

}  // namespace gearpod::mc
