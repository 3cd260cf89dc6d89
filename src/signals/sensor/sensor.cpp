#include "signals/sensor/sensor.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "signals/sensor/sensor_response_kernel.hpp"

namespace gearpod::signals {
namespace {

machine::AlignedVector lane_values(const machine::AlignedVector& values, std::size_t lanes,
                                   int lane) {
    machine::AlignedVector own;
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += lanes) {
        own.push_back(values[i]);
    }
    return own;
}

Tones tones_of_lane(const Tones& tones, int lanes, int lane) {
    return {
        lane_values(tones.mesh_period_s, lanes, lane), lane_values(tones.frequency_Hz, lanes, lane),
        lane_values(tones.amplitude_m_s2, lanes, lane), lane_values(tones.phase_rad, lanes, lane)};
}

// Number of lanes that are read together: one cache line holds their values.
constexpr int kTogether = 8;

std::vector<int> consecutive(int first, int count) {
    std::vector<int> meshes(static_cast<std::size_t>(std::max(0, count)));
    std::iota(meshes.begin(), meshes.end(), first);
    return meshes;
}

// Signals of the lanes from `first` on. If there are tones, the meshes must be consecutive.
std::vector<std::vector<double>> signals_of(const TileSignals& tile, int first,
                                            const Timeline& timeline, const SpanLayout& layout,
                                            const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes, const Tones& tones) {
    const int lanes = static_cast<int>(path_exponent.size());
    const int mesh_count = static_cast<int>(meshes.size());
    const int first_mesh = meshes.empty() ? 0 : meshes.front();
    check_tile(tile, timeline);
    if (first < 0 || lanes > tile.lanes - first || first_mesh < 0 ||
        path.first_source() + path.planets() > tile.sources() || path.phases() != tile.phases ||
        path.positions() != layout.carrier_meshes) {
        throw std::invalid_argument("sensor signal: tile, path and layout disagree in shape");
    }
    const std::size_t values = static_cast<std::size_t>(tile.phases) * tile.channels();
    const std::size_t turn = static_cast<std::size_t>(path.positions()) * path.planets();
    std::vector<double> whole_steps(path.positions() / 2 + 1), of_phase(turn);
    std::vector<double> accel(values * lanes);
    std::vector<std::vector<double>> weight, signal;
    std::vector<ToneTable> table;
    for (int n = 0; n < lanes; ++n) {
        weight.emplace_back(turn * tile.phases);
        path_weights_of_one_lane(
            {&path, &path_exponent[n], whole_steps.data(), of_phase.data(), weight.back().data()});
        signal.emplace_back(static_cast<std::size_t>(mesh_count) * tile.phases);
        table.emplace_back(tones_of_lane(tones, tile.lanes, first + n), 1, first_mesh, mesh_count,
                           tile.phases);
    }
    for (int i = 0; i < mesh_count; ++i) {
        const long k = meshes[static_cast<std::size_t>(i)];
        const double* mesh = tile.accel[timeline[k % static_cast<long>(timeline.size())]];
        copy_lanes({mesh, values * tile.lanes}, tile.lanes, first, accel);
        for (int n = 0; n < lanes; ++n) {
            SensorResponseArguments one;
            one.path = &path;
            one.carrier = static_cast<int>(k % path.positions());
            one.weight = weight[n].data() +
                         static_cast<std::size_t>(one.carrier) * tile.phases * path.planets();
            one.accel = accel.data() + n * values;
            one.sources = tile.sources();
            one.tones = table[n].tones() > 0 ? &table[n] : nullptr;
            one.mesh = i;
            one.meshes = mesh_count;
            one.signal = signal[n].data() + static_cast<std::size_t>(i) * tile.phases;
            sensor_response_of_one_lane(one);
        }
    }
    return signal;
}

}  // namespace

std::vector<double> synthesize(const TileSignals& tile, int lane, const Timeline& timeline,
                               const SpanLayout& layout, const PathGrid& path, double path_exponent,
                               int first_mesh, int mesh_count, const Tones& tones) {
    return std::move(signals_of(tile, lane, timeline, layout, path, {&path_exponent, 1},
                                consecutive(first_mesh, mesh_count), tones)
                         .front());
}

namespace {

// Signals of all lanes, computed kTogether lanes at a time.
std::vector<std::vector<double>> signals_of_all(const TileSignals& tile, const Timeline& timeline,
                                                const SpanLayout& layout, const PathGrid& path,
                                                std::span<const double> path_exponent,
                                                std::span<const int> meshes, const Tones& tones) {
    std::vector<std::vector<double>> signal;
    for (std::size_t n = 0; n < path_exponent.size(); n += kTogether) {
        auto some = signals_of(
            tile, static_cast<int>(n), timeline, layout, path,
            path_exponent.subspan(n, std::min<std::size_t>(kTogether, path_exponent.size() - n)),
            meshes, tones);
        std::move(some.begin(), some.end(), std::back_inserter(signal));
    }
    return signal;
}

}  // namespace

std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent, int first_mesh,
                                            int mesh_count, const Tones& tones) {
    return signals_of_all(tile, timeline, layout, path, path_exponent,
                          consecutive(first_mesh, mesh_count), tones);
}

std::vector<std::vector<double>> synthesize(const TileSignals& tile, const Timeline& timeline,
                                            const SpanLayout& layout, const PathGrid& path,
                                            std::span<const double> path_exponent,
                                            std::span<const int> meshes) {
    return signals_of_all(tile, timeline, layout, path, path_exponent, meshes, {});
}

}  // namespace gearpod::signals
